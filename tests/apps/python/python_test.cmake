# Tests of the Python module: one a file. Where it is not built one test says so, and is skipped.

if(TARGET penumbra_python)
  # Where no interpreter was found for pytest the tests say what to install and are skipped, too.
  execute_process(COMMAND ${PENUMBRA_PYTHON} -c "import numpy, pytest" RESULT_VARIABLE no_pytest ERROR_QUIET)
  if(no_pytest)
    set(python_missing "NumPy and pytest (python3-numpy, python3-pytest) are not installed for ${PENUMBRA_PYTHON}")
  endif()
elseif(NOT PENUMBRA_SANITIZE)
  set(python_missing "the module is not built; it needs python3-dev, pybind11-dev and PENUMBRA_BUILD_PYTHON")
endif()

if(python_missing)
  message(STATUS "The Python module is not tested: ${python_missing}")
  add_test(NAME python.module COMMAND ${CMAKE_COMMAND} -E echo "not tested: ${python_missing}")
  set_tests_properties(python.module PROPERTIES SKIP_REGULAR_EXPRESSION "not tested")
elseif(TARGET penumbra_python)
  file(GLOB python_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.py)
  foreach(file IN LISTS python_tests)
    get_filename_component(name ${file} NAME_WE)
    string(REPLACE "test_" "" name ${name})
    add_test(NAME python.${name} COMMAND ${PENUMBRA_PYTHON} -B -m pytest -q -rs -p no:cacheprovider ${file})
    set_tests_properties(python.${name} PROPERTIES TIMEOUT 300 ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python")
  endforeach()
  # As pip installs it into an environment of its own, without a network.
  add_test(NAME python.pip COMMAND ${PENUMBRA_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/pip_install.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  set_tests_properties(python.pip PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 RUN_SERIAL ON)
  # Serial: Ctrl-C is timed.
  set_tests_properties(python.long_calls PROPERTIES RUN_SERIAL ON)
  find_package(TBB REQUIRED)
  add_executable(penumbra_points_bench ${CMAKE_CURRENT_LIST_DIR}/bench/points_bench.cpp)
  target_link_libraries(penumbra_points_bench PRIVATE penumbra::visibility penumbra_oracle penumbra_internal TBB::tbb)
endif()
