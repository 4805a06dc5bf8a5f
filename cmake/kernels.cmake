# Kernels for several instruction sets, chosen at run time (continuum/isa/isa.hpp).
#
#   couloir_kernels(LIBRARY TABLE name SOURCES ... [LINK ...])
#
# compiles the sources once for each instruction set, with LIBRARY's definitions and COULOIR_TABLE = <name>_<isa>, and adds them to
# LIBRARY. One of the sources defines a table of functions by that name. The objects of a set are merged into one, in which nothing
# else stays visible: else the linker would keep one copy of a template or an inline function for all sets (std ones, too), and the
# program would die of an unknown instruction on an older machine.

set(COULOIR_ISAS baseline avx2 avx512)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")  # elsewhere all are the baseline, and the program chooses no other
  set(COULOIR_FLAGS_avx2 -march=x86-64-v3 -mtune=haswell)
  set(COULOIR_FLAGS_avx512 -march=x86-64-v4 -mtune=skylake-avx512 -mprefer-vector-width=512)
endif()

function(couloir_kernels library)
  cmake_parse_arguments(arg "" "TABLE" "SOURCES;LINK" ${ARGN})
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
  # For who builds another such library (bench), or looks at it (tests).
  set_target_properties(${library} PROPERTIES KERNEL_TABLE ${arg_TABLE} KERNEL_SOURCES "${arg_SOURCES}" KERNEL_LINK "${arg_LINK}")
  foreach(isa IN LISTS COULOIR_ISAS)
    set(part ${library}_${isa})
    set(table ${arg_TABLE}_${isa})
    set(merged ${CMAKE_CURRENT_BINARY_DIR}/${part}.o)
    add_library(${part} OBJECT EXCLUDE_FROM_ALL ${arg_SOURCES})
    target_link_libraries(${part} PRIVATE ${arg_LINK} OpenMP::OpenMP_CXX)
    # The inner loops vectorise only where sqrt need not set errno and a branch not taken need not trap; neither changes a bit.
    target_compile_options(${part} PRIVATE -fno-math-errno -fno-trapping-math ${COULOIR_FLAGS_${isa}})
    target_compile_definitions(${part} PRIVATE COULOIR_TABLE=${table} $<TARGET_PROPERTY:${library},COMPILE_DEFINITIONS>)
    add_custom_command(
      OUTPUT ${merged}
      COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${merged} $<TARGET_OBJECTS:${part}>
      COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${table} ${merged}
      DEPENDS ${part} $<TARGET_OBJECTS:${part}>
      COMMENT "Merging the kernels ${table}"
      COMMAND_EXPAND_LISTS VERBATIM)
    set_source_files_properties(${merged} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
    target_sources(${library} PRIVATE ${merged})
    set_property(TARGET ${library} APPEND PROPERTY KERNEL_OBJECTS ${merged})
  endforeach()
endfunction()
