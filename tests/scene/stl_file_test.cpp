#include "coupling/scene/stl_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace couloir {
namespace {

using testing::HasSubstr;

class StlFile : public testing::Test {
 protected:
  std::string path_ = (std::filesystem::temp_directory_path() / ("couloir_stl_" + std::to_string(::getpid()) + ".stl")).string();
  void TearDown() override { std::filesystem::remove(path_); }

  std::vector<StlTriangle> read(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    return read_stl(path_);
  }
  std::string error(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const StlError& e) {
      return e.what();
    }
    return "";
  }
};

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0.1 0 0\nvertex 1e1 -2.5E-1 +3\nvertex 0 1 0\nendloop\nendfacet\n";
const StlTriangle corners{{{0.1, 0, 0}, {10, -0.25, 3}, {0, 1, 0}}};

std::string binary(const std::vector<StlTriangle>& triangles, const std::string& header = "made by hand") {
  std::string out = header;
  out.resize(80);
  const auto put = [&](auto x) {
    char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    out.append(bytes, sizeof x);
  };
  put(std::uint32_t(triangles.size()));
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) put(0.f);
    for (const auto& corner : t)
      for (const double x : corner) put(float(x));
    put(std::uint16_t(0));
  }
  return out;
}

TEST_F(StlFile, ReadsTextToTheLastDigitInAnyCaseAndSpacing) {
  EXPECT_EQ(read("solid a name with words\n" + facet + facet + "endsolid a name with words\n"),
            (std::vector<StlTriangle>{corners, corners}));
  std::string loud = "  SOLID\r\n" + facet + "EndSolid\r\n";
  for (std::size_t at = 0; (at = loud.find("vertex", at)) != std::string::npos;) loud.replace(at, 6, "\t VERTEX");
  EXPECT_EQ(read(loud), std::vector<StlTriangle>{corners});
  EXPECT_EQ(read("solid\n" + facet + "endsolid\nsolid two\n" + facet + "endsolid two").size(), 2u);
}

TEST_F(StlFile, ReadsBinaryAlsoWhereItBeginsLikeAText) {
  const StlTriangle floats{{{0.5, 0, 0}, {10, -0.25, 3}, {0, 1, 0}}};
  EXPECT_EQ(read(binary({floats, floats})), (std::vector<StlTriangle>{floats, floats}));
  EXPECT_EQ(read(binary({floats}, "solid but binary")), std::vector<StlTriangle>{floats});
}

TEST_F(StlFile, SaysWhatIsWrong) {
  const std::string whole = "solid\n" + facet + "endsolid\n";
  EXPECT_EQ(error(""), "is empty; export the body anew");
  EXPECT_EQ(error("hello\n"),
            "is no STL file: line 1 has 'hello' where solid should come; export the body as STL, text or binary");
  EXPECT_EQ(error("solid\nendsolid\n"), "holds no triangle; export the body anew");
  std::string bad = whole;
  bad.replace(bad.find("1e1"), 3, "abc");
  EXPECT_EQ(error(bad), "is no STL file: line 5 has 'abc' where a number should come; export the body as STL, text or binary");
  bad.replace(bad.find("abc"), 3, "inf");
  EXPECT_THAT(error(bad), HasSubstr("'inf' where a number should come"));
  // Wherever a text is cut off between words.
  for (std::size_t end = 6; end < whole.size() - 9; ++end)
    if (whole[end] == '\n' || whole[end] == ' ') {
      EXPECT_THAT(error(whole.substr(0, end)), HasSubstr("is no whole STL file: it ends where"));
    }
  EXPECT_THAT(error(std::string(684, '\0')), HasSubstr("is no STL file: line 1 has '????"));
  const std::string cut = binary({corners, corners});
  EXPECT_THAT(error(cut.substr(0, cut.size() - 1)), HasSubstr("is no STL file"));
  std::string none = binary({corners});
  none.replace(96, 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(error(none), "has a corner that is no number, in triangle 1; export it anew");
  std::filesystem::remove(path_);
  EXPECT_THROW(read_stl(path_), StlError);
  EXPECT_THROW(read_stl("/"), StlError);
}

}  // namespace
}  // namespace couloir
