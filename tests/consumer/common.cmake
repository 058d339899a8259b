# run(COMMAND...): runs it in FOLDER and fails where it fails.
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${FOLDER} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# use_folder(NAME): FOLDER is the empty folder NAME below WORK.
macro(use_folder name)
  set(FOLDER ${WORK}/${name})
  file(REMOVE_RECURSE ${FOLDER})
  file(MAKE_DIRECTORY ${FOLDER})
endmacro()

# try_program(PROGRAM): runs it with ARGUMENTS and looks at the libraries that it links: one of the pattern LINKED (which shows that
# looking works), none of the pattern NOT_LINKED.
function(try_program program)
  run(${program} ${ARGUMENTS})
  execute_process(COMMAND ldd ${program} OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
  if(NOT libraries MATCHES "lib(${LINKED})[A-Za-z0-9]*[-.]")
    message(FATAL_ERROR "${program} does not link ${LINKED}:\n${libraries}")
  endif()
  if(libraries MATCHES "lib(${NOT_LINKED})[A-Za-z0-9]*[-.]")
    message(FATAL_ERROR "${program} links ${CMAKE_MATCH_0}:\n${libraries}")
  endif()
endfunction()
