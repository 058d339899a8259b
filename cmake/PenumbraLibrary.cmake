# penumbra_library(NAME): the static library penumbra_NAME (alias penumbra::NAME) from every .cpp of the calling folder
# and, where EXTRA names them, of its sub-folders; where ONLY names sub-folders, of those alone. Headers are installed with
# the same layout.
include(GNUInstallDirs)

add_library(penumbra_flags INTERFACE)
target_compile_options(penumbra_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -fno-math-errno -fno-trapping-math -ffp-contract=off)
if(PENUMBRA_WERROR)
  target_compile_options(penumbra_flags INTERFACE -Werror)
endif()
if(PENUMBRA_FUZZ)
  target_compile_options(penumbra_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(PENUMBRA_SANITIZE OR PENUMBRA_FUZZ)
  target_compile_options(penumbra_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
  target_link_options(penumbra_flags INTERFACE -fsanitize=address,undefined)
endif()

function(penumbra_library name)
  cmake_parse_arguments(ARG "" "" "EXTRA;ONLY" ${ARGN})
  if(NOT ARG_ONLY)
    file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  endif()
  foreach(folder IN LISTS ARG_EXTRA ARG_ONLY)
    file(GLOB more CONFIGURE_DEPENDS ${folder}/*.cpp)
    list(APPEND sources ${more})
  endforeach()
  add_library(penumbra_${name} STATIC ${sources})
  add_library(penumbra::${name} ALIAS penumbra_${name})
  set_target_properties(penumbra_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(penumbra_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/penumbra>)
  target_link_libraries(penumbra_${name} PRIVATE $<BUILD_INTERFACE:penumbra_flags>)
  target_compile_features(penumbra_${name} PUBLIC cxx_std_20)
  install(TARGETS penumbra_${name} EXPORT penumbra-targets)
endfunction()
