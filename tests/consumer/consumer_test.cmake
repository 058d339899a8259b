# A project that uses the installed library: see run_consumer.cmake. And its source is the README's sample.
add_test(NAME consumer.find_package
         COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/consumer
                 -DWORK=${CMAKE_CURRENT_BINARY_DIR}/consumer -DGENERATOR=${CMAKE_GENERATOR}
                 -DCOMPILER=${CMAKE_CXX_COMPILER} -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/run_consumer.cmake)
add_test(NAME consumer.readme_sample
         COMMAND ${CMAKE_COMMAND} -DREADME=${PROJECT_SOURCE_DIR}/README.md
                 -DSAMPLE=${CMAKE_CURRENT_SOURCE_DIR}/consumer/main.cpp
                 -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/readme_sample.cmake)
set_tests_properties(consumer.find_package consumer.readme_sample PROPERTIES TIMEOUT 300)
