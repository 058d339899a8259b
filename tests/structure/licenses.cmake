# penumbra::volumes uses no package of CGAL under the GPL: none of the headers that its sources include, directly or not,
# says so. Those of penumbra::checks do, which shows that the test can find them. Arguments: COMPILER, SOURCE (the top of the
# tree), INCLUDE (where public headers are).

# gpl_headers(OUT COUNT FILES...): CGAL's headers under the GPL that the files include; COUNT of all of CGAL's.
function(gpl_headers out count)
  execute_process(COMMAND ${COMPILER} -std=c++20 -M -I${SOURCE} -I${INCLUDE} ${ARGN} OUTPUT_VARIABLE headers
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^ \n]+/CGAL/[^ \n]+" headers "${headers}")
  list(REMOVE_DUPLICATES headers)
  set(found)
  foreach(header IN LISTS headers)
    file(STRINGS ${header} license REGEX "SPDX-License-Identifier: *GPL" LIMIT_COUNT 1)
    if(license)
      list(APPEND found ${header})
    endif()
  endforeach()
  list(LENGTH headers length)
  set(${count} ${length} PARENT_SCOPE)
  set(${out} ${found} PARENT_SCOPE)
endfunction()

file(GLOB checks ${SOURCE}/volumes/checks/*.cpp)
file(GLOB_RECURSE volumes ${SOURCE}/volumes/*.cpp)
list(REMOVE_ITEM volumes ${checks})
gpl_headers(of_volumes count ${volumes})
message("volumes include ${count} headers of CGAL")
if(of_volumes OR count LESS 100)
  message(FATAL_ERROR "Under the GPL: ${of_volumes}")
endif()
gpl_headers(of_checks count ${checks})
list(LENGTH of_checks length)
message("checks include ${count} headers of CGAL, ${length} of them under the GPL")
if(NOT of_checks)
  message(FATAL_ERROR "No header under the GPL is found where there are some")
endif()
