# Compile flags of the whole project, and how a library is made of the folders of a module.
include(GNUInstallDirs)

add_library(penumbra_flags INTERFACE)
target_compile_options(penumbra_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -fno-math-errno -fno-trapping-math -ffp-contract=off)
# Loops that become vectors join comparisons by &, without a branch; clang takes that for a slip. Vectors are returned by
# functions that are inlined, so that no ABI is at stake.
target_compile_options(penumbra_flags INTERFACE "$<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical;-Wno-psabi>")
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

# Public headers are included as <penumbra/FOLDER/NAME.h>, here as well as by whoever uses the installed library. In the
# source tree they stand beside the code that they are the contract of; this folder links to them, and to nothing else.
set(PENUMBRA_PUBLIC_INCLUDE ${PROJECT_BINARY_DIR}/include)

# Where modules are that are opened at run time, and where this project's programs look for them: built, and installed.
set(PENUMBRA_MODULES ${PROJECT_BINARY_DIR}/lib)
file(RELATIVE_PATH penumbra_up ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/penumbra)
list(APPEND CMAKE_BUILD_RPATH ${PENUMBRA_MODULES})
list(APPEND CMAKE_INSTALL_RPATH \$ORIGIN/${penumbra_up})

# penumbra_library(NAME FOLDERS... [FILES...] [PUBLIC HEADERS...]): the static library penumbra_NAME (alias penumbra::NAME)
# from every .cpp of the folders, and the files. All are relative to the calling folder. The headers are public: they are linked into
# PENUMBRA_PUBLIC_INCLUDE and installed; all others are internal. The global property PENUMBRA_PUBLIC_HEADERS names the
# public headers of all libraries, PENUMBRA_PUBLIC_HEADERS_NAME those of one.
function(penumbra_library name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;FILES;PUBLIC" ${ARGN})
  set(sources ${ARG_FILES})
  foreach(folder IN LISTS ARG_FOLDERS)
    file(GLOB more CONFIGURE_DEPENDS ${folder}/*.cpp)
    list(APPEND sources ${more})
  endforeach()
  add_library(penumbra_${name} STATIC ${sources})
  add_library(penumbra::${name} ALIAS penumbra_${name})
  set_target_properties(penumbra_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(penumbra_${name} PUBLIC $<BUILD_INTERFACE:${PENUMBRA_PUBLIC_INCLUDE}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(penumbra_${name} PRIVATE $<BUILD_INTERFACE:penumbra_internal>)
  target_compile_features(penumbra_${name} PUBLIC cxx_std_20)
  if(PENUMBRA_INSTALL)
    install(TARGETS penumbra_${name} EXPORT penumbra-${name})
  endif()

  file(RELATIVE_PATH module ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(header IN LISTS ARG_PUBLIC)
    get_filename_component(folder ${PENUMBRA_PUBLIC_INCLUDE}/penumbra/${module}/${header} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${header} ${PENUMBRA_PUBLIC_INCLUDE}/penumbra/${module}/${header} SYMBOLIC)
    get_filename_component(installed penumbra/${module}/${header} DIRECTORY)
    if(PENUMBRA_INSTALL)
      install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${installed})
    endif()
    set_property(GLOBAL APPEND PROPERTY PENUMBRA_PUBLIC_HEADERS ${module}/${header})
    set_property(GLOBAL APPEND PROPERTY PENUMBRA_PUBLIC_HEADERS_${name} ${module}/${header})
  endforeach()
endfunction()

# What the project's own code needs to include internal headers, beside the flags.
add_library(penumbra_internal INTERFACE)
target_include_directories(penumbra_internal INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(penumbra_internal INTERFACE penumbra_flags)

# penumbra_precompile(TARGET [HEADERS...]): headers that most of the target's files include are parsed once for all, which halves the time it
# takes to build them: glm's and the standard library's that are dear, and HEADERS of other projects. Never our own. Files still include
# what they use: the preset clang builds without.
function(penumbra_precompile target)
  if(PENUMBRA_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <filesystem> <functional> <map> <memory> <optional> <random> <ranges> <span>
                              <string> <variant> <vector> <glm/geometric.hpp> <glm/glm.hpp> ${ARGN})
  endif()
endfunction()

# penumbra_build_fast(TARGET): for what no one waits for when it runs. It is built in two thirds of the time.
function(penumbra_build_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# penumbra_embed(OUT HEADER NAMESPACE FUNCTION FILES...): a rule that writes the files as constants into the source file OUT, so
# that a program finds them wherever it runs: NAMESPACE::FUNCTION(name), which HEADER declares.
function(penumbra_embed out header namespace function)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DHEADER=${header} -DNAMESPACE=${namespace} -DFUNCTION=${function}
            "-DFILES=${ARGN}" -P ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake VERBATIM)
endfunction()
