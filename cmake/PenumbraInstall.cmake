# `cmake --install`, `find_package(penumbra 0.2 COMPONENTS volumes)` and `pkg-config penumbra-volumes`. Public headers are
# installed by penumbra_library, programs by their own CMakeLists.txt.
include(CMakePackageConfigHelpers)

set(penumbra_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
set(penumbra_pkg_config_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
set(penumbra_component_table "")

# penumbra_component(NAME DESCRIPTION [NEEDS COMPONENTS...] [PACKAGES "ARGUMENTS OF find_package"...] [PUBLIC_MODULES MODULES...]
#                    [MODULES MODULES...] [FLAGS FLAGS...])
# What a program that links penumbra::NAME has to find. The libraries are static, so this includes what they use privately.
# Modules are those of pkg-config. PUBLIC_MODULES are included by public headers. FLAGS link what has no module.
function(penumbra_component name description)
  if(NOT TARGET penumbra_${name})
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "NEEDS;PACKAGES;PUBLIC_MODULES;MODULES;FLAGS" ${ARGN})
  install(EXPORT penumbra-${name} NAMESPACE penumbra:: DESTINATION ${penumbra_cmake_dir})
  string(APPEND penumbra_component_table "list(APPEND _penumbra_built ${name})\n"
         "set(_penumbra_needs_${name} \"${ARG_NEEDS}\")\nset(_penumbra_packages_${name} \"${ARG_PACKAGES}\")\n")
  set(penumbra_component_table "${penumbra_component_table}" PARENT_SCOPE)

  list(TRANSFORM ARG_NEEDS PREPEND penumbra-)
  list(JOIN ARG_NEEDS " " needs)
  list(JOIN ARG_PUBLIC_MODULES " " public_modules)
  list(JOIN ARG_MODULES " " modules)
  list(JOIN ARG_FLAGS " " flags)
  # The prefix is found from where the .pc file is, so that an installed tree can be moved.
  set(prefix ${CMAKE_INSTALL_PREFIX})
  if(NOT IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} AND NOT IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
    file(RELATIVE_PATH up /${penumbra_pkg_config_dir} /)
    string(REGEX REPLACE "/$" "" up ${up})
    set(prefix "\${pcfiledir}/${up}")
  endif()
  set(libdir ${CMAKE_INSTALL_LIBDIR})
  set(includedir ${CMAKE_INSTALL_INCLUDEDIR})
  foreach(folder libdir includedir)
    if(NOT IS_ABSOLUTE ${${folder}})
      set(${folder} "\${prefix}/${${folder}}")
    endif()
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/penumbra.pc.in ${PROJECT_BINARY_DIR}/penumbra-${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/penumbra-${name}.pc DESTINATION ${penumbra_pkg_config_dir})
endfunction()

# Each after those that it needs.
penumbra_component(mesh "half-edge triangle meshes, their files, shapes, checks"
                   PACKAGES glm "OpenMesh CONFIG" PUBLIC_MODULES glm MODULES openmesh)
penumbra_component(volumes "umbra and penumbra volumes of meshes under a disk light"
                   NEEDS mesh PACKAGES TBB MODULES tbb gmp mpfr)
penumbra_component(checks "checks and repair of volumes and meshes (with CGAL packages under the GPL)"
                   NEEDS volumes PACKAGES TBB MODULES tbb gmp mpfr)
# Where the loader finds the modules of OpenVDB and GDAL.
set(module_flags -ldl)
if(TARGET penumbra_vdb OR TARGET penumbra_gdal)
  list(APPEND module_flags "-Wl,-rpath,\${libdir}/penumbra")
endif()
penumbra_component(visibility "visibility of a light from points, without OpenGL"
                   NEEDS volumes PACKAGES "embree 3" TBB MODULES tbb FLAGS -lembree3 ${module_flags})
penumbra_component(render "images of soft shadows"
                   NEEDS visibility PACKAGES "embree 3" TBB OpenEXR MODULES tbb OpenEXR FLAGS -lembree3 -ldl)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/penumbra-config.cmake.in
                              ${PROJECT_BINARY_DIR}/penumbra-config.cmake INSTALL_DESTINATION ${penumbra_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/penumbra-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/penumbra-config.cmake ${PROJECT_BINARY_DIR}/penumbra-config-version.cmake
        DESTINATION ${penumbra_cmake_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
