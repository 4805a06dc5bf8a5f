# Targets that read, write and report rather than compute are built for seconds of work: less is optimised in them than in the
# solver, and their large common headers are read once.
add_library(couloir_frontend_headers OBJECT cmake/frontend_headers.cpp)
target_link_libraries(couloir_frontend_headers PRIVATE couloir_options fmt::fmt nlohmann_json::nlohmann_json)
target_compile_options(couloir_frontend_headers PRIVATE $<$<CONFIG:Release>:-O1>)
target_precompile_headers(couloir_frontend_headers PRIVATE <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>
  <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <numeric> <optional> <sstream> <string> <vector>)

# couloir_frontend(name [APART]): four sources are compiled at a time, whose names must differ; APART: they need not.
function(couloir_frontend name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_precompile_headers(${name} REUSE_FROM couloir_frontend_headers)
  if(NOT ARGN)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
  endif()
endfunction()
