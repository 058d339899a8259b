# The documents are tested: tests/docs/README.md says how.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# docs_test(NAME SCRIPT ARGUMENTS...)
function(docs_test name script)
  add_test(NAME docs.${name} COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/docs/${script} ${ARGN})
  set_tests_properties(docs.${name} PROPERTIES TIMEOUT 300)
endfunction()

docs_test(links text.py links)
docs_test(samples text.py samples)
docs_test(not_run text.py not-run)
docs_test(tables tables.py --check)

if(TARGET penumbra::render)
  consumer_test(examples ../docs/examples -DEXAMPLES=${PROJECT_SOURCE_DIR}/apps/examples -DDATA=${PROJECT_SOURCE_DIR}/data)
  set_tests_properties(consumer.examples PROPERTIES FIXTURES_REQUIRED penumbra_installed)
endif()

# One test for each document that has a command to run.
if(TARGET penumbra_cli)
  docs_test(options options.py $<TARGET_FILE:penumbra_cli>)
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/docs/commands.py --list
                  OUTPUT_VARIABLE documents OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" documents ${documents})
  foreach(document IN LISTS documents)
    string(REGEX REPLACE "^docs/|\\.md$" "" name ${document})
    string(REPLACE "/" "." name ${name})
    docs_test(commands.${name} commands.py ${document} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${CMAKE_CURRENT_BINARY_DIR}/docs/${name})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${document})
  endforeach()
endif()
