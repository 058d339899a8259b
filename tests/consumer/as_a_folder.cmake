# Builds penumbra::mesh in a project that has PENUMBRA as a folder, and runs a program that links it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
use_folder(as_a_folder)
run(${CMAKE_COMMAND} -S ${SOURCE}/parent -B ${FOLDER} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
    -DPENUMBRA=${PENUMBRA})
run(${CMAKE_COMMAND} --build ${FOLDER} --target consumer)
run(${FOLDER}/programs/consumer)
