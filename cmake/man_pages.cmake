# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# What is installed of a program, in component "programs":
#   cgt_install_program(<target> <what it does>)
#       The program; its man page, made from its --help by help2man at build time, where that is there and the program
#       runs on this machine; and its completion in bash.
if(CGT_INSTALL AND NOT CMAKE_CROSSCOMPILING AND NOT CGT_SANITIZE)
    find_program(CGT_HELP2MAN help2man DOC "Makes man pages of the programs")
endif()

function(cgt_install_program target summary)
    if(NOT CGT_INSTALL)
        return()
    endif()
    install(TARGETS ${target} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
    install(FILES "${PROJECT_SOURCE_DIR}/programs/completion/cgt.bash" RENAME ${target}
            DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT programs)
    if(NOT CGT_HELP2MAN OR CMAKE_CROSSCOMPILING OR CGT_SANITIZE)
        return()
    endif()
    set(page "${PROJECT_BINARY_DIR}/man/${target}.1")
    set(script "${PROJECT_SOURCE_DIR}/cmake/man_page.sh")
    file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/man")
    add_custom_command(OUTPUT "${page}"
                       COMMAND sh "${script}" "${CGT_HELP2MAN}" "$<TARGET_FILE:${target}>" "${summary}" "${page}"
                       DEPENDS ${target} "${script}" COMMENT "Man page ${target}.1" VERBATIM)
    add_custom_target(${target}.1 ALL DEPENDS "${page}")
    install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT programs)
endfunction()
