# Builds the project beside this script with the installed COMPONENT, runs it and looks at what it links.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
use_folder(find_package/${COMPONENT})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug
    -DCMAKE_PREFIX_PATH=${WORK}/installed/prefix -DCOMPONENT=${COMPONENT} -DHEADERS=${HEADERS})
run(${CMAKE_COMMAND} --build ${FOLDER})
try_program(${FOLDER}/consumer)
