# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Completion in bash for cgt-render, cgt-view, cgt-convert and cgt-bench. Options and sub-commands are those that the
# program itself lists by --help, so that they fit any version, and so do values that are one of a few words. All other
# values are completed as files. Installed under the name of each program, where bash looks for it.

# _cgt_options PROGRAM [SUB-COMMAND]: the long options of its --help; one that needs a value ends in =.
_cgt_options() {
    "$@" --help 2>/dev/null | sed -n 's/^ \{1,8\}\(-[^ -], \)\{0,1\}\(--[a-z0-9][a-z0-9-]*=\{0,1\}\).*/\2/p'
}

# _cgt_subcommands PROGRAM: those in the lines of usage.
_cgt_subcommands() {
    "$1" --help 2>/dev/null | sed -n 's/^ *\(Usage:\|or:\) *cgt-bench \[OPTION\.\.\.\] \([a-z]*\) *.*/\2/p'
}

# _cgt_values PROGRAM [SUB-COMMAND] OPTION: the words that its value may be, or nothing: they stand in the program's
# table of options.
_cgt_values() {
    local name=${!#}
    name=${name#-}
    "${@:1:$#-1}" --__words="${name#-}" 2>/dev/null
}

_cgt() {
    local program=$1 current=${COMP_WORDS[COMP_CWORD]} option='' bench=${1##*/}
    local words='' command=("$program")
    COMPREPLY=()
    if [[ $bench == cgt-bench && $COMP_CWORD -gt 1 && ${COMP_WORDS[1]} != -* ]]; then
        command+=("${COMP_WORDS[1]}") # where -k and others mean something of their own
    fi
    # --option=value comes as three words where = breaks words
    if [[ $current == --*=* ]]; then
        option=${current%%=*} current=${current#*=}
    elif [[ $current == '=' ]]; then
        option=${COMP_WORDS[COMP_CWORD - 1]} current=''
    elif ((COMP_CWORD > 1)) && [[ ${COMP_WORDS[COMP_CWORD - 1]} == '=' ]]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif ((COMP_CWORD > 0)) && [[ $current != -* && ${COMP_WORDS[COMP_CWORD - 1]} == -* ]]; then
        option=${COMP_WORDS[COMP_CWORD - 1]} # --option value
    fi
    if [[ -n $option ]]; then
        words=$(_cgt_values "${command[@]}" "$option")
    elif [[ $current == -* ]]; then
        words=$(_cgt_options "${command[@]}")
    elif [[ $bench == cgt-bench && $COMP_CWORD -eq 1 ]]; then
        words=$(_cgt_subcommands "$program")
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    # no blank behind an option that waits for its value
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == --*= ]]; then
        compopt -o nospace 2>/dev/null
    fi
}

complete -o bashdefault -o default -F _cgt cgt-render cgt-view cgt-convert cgt-bench
