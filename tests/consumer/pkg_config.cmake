# Compiles the same program with what pkg-config says of the installed COMPONENT, runs it and looks at what it links.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
use_folder(pkg_config/${COMPONENT})
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE module ${WORK}/installed/prefix/*/penumbra-${COMPONENT}.pc)
get_filename_component(modules ${module} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${modules})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs --static "penumbra-${COMPONENT} >= 0.2" OUTPUT_VARIABLE flags
                COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${COMPILER} -std=c++20 -Wall -Wextra -Wpedantic -Werror ${SOURCE}/${COMPONENT}.cpp ${HEADERS} -o consumer ${flags})
set(LINKED OpenMesh)
try_program(${FOLDER}/consumer)
