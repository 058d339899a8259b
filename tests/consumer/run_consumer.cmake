# Installs BUILD below WORK, builds the project SOURCE against it, runs the result and looks at what it links.
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
if(EXISTS ${WORK}/build/checks_consumer)
  run(${WORK}/build/checks_consumer)
endif()

file(SIZE ${WORK}/penumbra.ply size)
if(size LESS 1000)
  message(FATAL_ERROR "penumbra.ply has only ${size} bytes")
endif()
execute_process(COMMAND ldd ${WORK}/build/consumer OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
if(libraries MATCHES "lib(GL|EGL|OSMesa|glfw|embree|OpenEXR)")
  message(FATAL_ERROR "A program that wants only volumes links ${CMAKE_MATCH_0}:\n${libraries}")
endif()
