# SPDX-License-Identifier: LGPL-3.0-or-later
# Object types that are not Orca's own, in Orca's own build and in others. OrcaPlugin.cmake includes this file; set before is also
#   ORCA_IDL_FILES  folder of Orca's own IDL files
#   ORCA_IDL_TOOLS  folder of the generator

# orca_generate_idl(NAME FILES files.idl...)
#
# Builds plugins/NAME.so, a library of the object types that the IDL files declare in a module of their own, and plugins/NAME.types,
# which lists them for the loader. A component that uses them says orca_add_component(... LINK NAME) and includes "NAME/FILE.hpp". The
# files may #include Orca's own, and extend or hold orca::idl::T (docs/adr/0099-object-types-of-others.md).
function(orca_generate_idl name)
  cmake_parse_arguments(arg "" "" "FILES" ${ARGN})
  if(NOT arg_FILES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "orca_generate_idl(${name} ...): write orca_generate_idl(${name} FILES one.idl two.idl)")
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  list(TRANSFORM arg_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]" OUTPUT_VARIABLE files)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/idl/${name}/include)
  set(made ${include}/${name}/generated)
  set(headers)
  foreach(file ${files})
    cmake_path(GET file STEM stem)
    list(APPEND headers ${include}/${name}/${stem}.hpp ${made}/${stem}.h ${made}/${stem}.types.hpp ${made}/${stem}.reflection.hpp)
  endforeach()
  file(GLOB inputs CONFIGURE_DEPENDS ${ORCA_IDL_TOOLS}/*.py ${ORCA_IDL_FILES}/*.idl)
  add_custom_command(
    OUTPUT ${headers} ${made}/object_types.cpp ${made}/object_layouts.cpp ${made}/${name}.types
    COMMAND ${Python3_EXECUTABLE} -B ${ORCA_IDL_TOOLS}/generate.py --out ${include} --library ${name}
            --orca ${ORCA_IDL_FILES} ${files}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${ORCA_PLUGIN_DIR}
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${made}/${name}.types ${ORCA_PLUGIN_DIR}/${name}.types
    DEPENDS ${files} ${inputs} COMMENT "C++ from the IDL files of ${name}" VERBATIM)
  orca_add_object_library(${name} ${made} ${include} ${headers} ${made}/object_types.cpp)
endfunction()

# The library, from what was generated. Nobody here could mend what a compiler warns of in generated code.
function(orca_add_object_library name made include)
  set(idl Orca::idl Orca::language)
  if(TARGET orca_idl)
    set(idl orca_idl orca_language)
  endif()
  # What the types looked like goes into the library and into all that uses it, so that an error can say what has changed.
  add_library(${name}_layouts OBJECT ${made}/object_layouts.cpp)
  target_compile_features(${name}_layouts PRIVATE cxx_std_20)
  set_target_properties(${name}_layouts PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_library(${name} SHARED ${ARGN} $<TARGET_OBJECTS:${name}_layouts> ${ORCA_PLUGIN_SUPPORT_DIR}/object_library_entry.cpp)
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${ORCA_PLUGIN_DIR} UNITY_BUILD OFF)
  target_compile_options(${name} PRIVATE -w)
  target_include_directories(${name} SYSTEM PUBLIC ${include})
  target_link_libraries(${name} PUBLIC ${idl})
  target_link_options(${name} PRIVATE -Wl,--build-id -Wl,-z,nodelete)
  target_sources(${name} INTERFACE $<TARGET_OBJECTS:${name}_layouts>)
  orca_use_plugin_layouts(${name})
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGINS ${name})
  orca_keep_plugin(${ORCA_PLUGIN_DIR} ${name})
endfunction()
