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

if(TARGET penumbra_cli)
  file(GLOB_RECURSE documents CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/docs/*.md)
  foreach(document IN LISTS documents ITEMS README.md CONTRIBUTING.md)
    string(REGEX REPLACE "^docs/|\\.md$" "" name ${document})
    string(REPLACE "/" "." name ${name})
    docs_test(commands.${name} commands.py ${document} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${CMAKE_CURRENT_BINARY_DIR}/docs/${name})
  endforeach()
endif()
