#pragma once
// STL files, text and binary: triangles without order or unit.
//
//   solid NAME                              80 bytes of anything
//     facet normal 0 0 1                    n                      uint32
//       outer loop                          n times: normal, 3 corners   12 float32
//         vertex 0 0 0 ...                           attribute           uint16
//
// A file of exactly 84 + 50 n bytes is binary, whatever its first words. Normals are not read: the corners' order has them.
// Source: StereoLithography Interface Specification, 3D Systems, 1988. All numbers are little-endian.

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace couloir {

using StlTriangle = std::array<std::array<double, 3>, 3>;  // corners, counter-clockwise seen from outside

// what() tells what is wrong, without the file's name: "is no STL file: line 3 is 'vertex 1 a 0', ...".
struct StlError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws StlError where there is no such file, it is empty, or it is no STL file.
std::vector<StlTriangle> read_stl(const std::string& path);

}  // namespace couloir
