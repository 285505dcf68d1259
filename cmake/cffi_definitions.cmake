# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# cmake -DOUTPUT=FILE -DHEADERS=A.h,B.h -P cffi_definitions.cmake
# Writes the declarations of headers, in their order, as cffi's parser takes them: without comments, directives, CGT_API
# and what is for C++ alone, and without inline functions; constants as numbers.
string(REPLACE "," ";" headers "${HEADERS}")
set(all "")
foreach(header IN LISTS headers)
    file(READ "${header}" text)
    string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" text "${text}")
    string(REGEX REPLACE "#ifdef __cplusplus[^#]*#endif" "" text "${text}")
    string(REGEX REPLACE "static inline [^;{]*{.*\n}\n" "" text "${text}") # they follow each other
    string(REPLACE "\\\n" " " text "${text}")
    string(REGEX REPLACE "CGT_([A-Z]+_)?API " "" text "${text}")
    # cffi 1.15 writes a pointer to arrays of const in a way that compilers refuse
    string(REGEX REPLACE "const ([a-z0-9_]+) \\(\\*" "\\1 (*" text "${text}")
    string(REPLACE "UINT32_MAX" "4294967295" text "${text}")
    string(REGEX REPLACE "#define (CGT_[A-Z0-9_]+) +\\(\\([a-z_]+\\)([0-9]+)\\)" "#define \\1 \\2" text "${text}")
    string(REGEX REPLACE "#define (CGT_[A-Z0-9_]+) +([0-9]+)" "constant \\1 \\2" text "${text}")
    string(REGEX REPLACE "#[^\n]*" "" text "${text}")
    string(REGEX REPLACE "constant (CGT_[A-Z0-9_]+ [0-9]+)" "#define \\1" text "${text}")
    string(REGEX REPLACE "[ \t]+\n" "\n" text "\n${text}")
    string(REGEX REPLACE "\n\n+" "\n" text "${text}")
    string(APPEND all "${text}")
endforeach()
string(REGEX REPLACE "^\n" "" all "${all}")
file(WRITE "${OUTPUT}" "${all}")
