#include "coupling/engine/protocol.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "small_box.hpp"

using namespace couloir;
using testing::HasSubstr;

TEST(Protocol, SetupGoesThereAndBack) {
  protocol::Start in, out;
  in.setup = test::box("/somewhere");
  in.setup.periodic = {true, false, true};
  in.setup.faces = {{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, 0.01, 3, 0.004, 0.008}};
  in.setup.tangential_damping = false;
  in.restore = "file";
  protocol::decode(protocol::encode(in), out);
  EXPECT_EQ(out.restore, "file");
  EXPECT_EQ(out.setup.work_dir, "/somewhere");
  EXPECT_EQ(out.setup.timestep, in.setup.timestep);
  EXPECT_EQ(out.setup.periodic, in.setup.periodic);
  EXPECT_FALSE(out.setup.tangential_damping);
  ASSERT_EQ(out.setup.surfaces.size(), 5u);
  EXPECT_EQ(out.setup.surfaces[4].triangles[1].c, in.setup.surfaces[4].triangles[1].c);
  EXPECT_EQ(out.setup.surfaces[4].name, "y1");
  EXPECT_EQ(out.setup.faces[0].segments, 3);
  EXPECT_EQ(out.setup.faces[0].strip_end, 0.008);
}

TEST(Protocol, RequestAndAnswerGoThereAndBack) {
  AdvanceRequest in, out;
  in.steps = 40;
  in.insert = test::lattice(2, 2);
  in.insert[3].face = 0;
  in.insert[3].segment = 2;
  in.remove = {7, 9};
  in.drives = {{{1, 2, -0.1, 0.3, 1e-6, true, {4, 5, 6}}, {}}};
  in.want_grains = false;
  in.sample_steps = 5;
  protocol::decode(protocol::encode(in), out);
  EXPECT_EQ(out.steps, 40);
  EXPECT_EQ(out.insert[3].segment, 2);
  EXPECT_EQ(out.insert[7].position, in.insert[7].position);
  EXPECT_EQ(out.remove, in.remove);
  ASSERT_EQ(out.drives[0].size(), 2u);
  EXPECT_TRUE(out.drives[0][0].exit_active);
  EXPECT_EQ(out.drives[0][0].exit_velocity, (Vec{4, 5, 6}));
  EXPECT_FALSE(out.want_grains);
  EXPECT_EQ(out.sample_steps, 5);

  Advanced a, b;
  a.step = 123456789012;
  a.grains.id = {1, 5};
  a.grains.x = {0.1, std::nextafter(0.1, 1)};
  a.grains.driven = {0, 1};
  a.surface_force = {{1, 2, 3}};
  a.segments = {{{0.5, 1, 2, 3}}};
  a.surface_force_samples = {{{1, 2, 3}, {4, 5, 6}}, {}};
  protocol::decode(protocol::encode(a), b);
  EXPECT_EQ(b.step, a.step);
  EXPECT_TRUE(test::same_bits(a.grains.x, b.grains.x));
  EXPECT_EQ(b.grains.driven, a.grains.driven);
  EXPECT_EQ(b.surface_force, a.surface_force);
  EXPECT_EQ(b.segments[0][0].force, 2);
  EXPECT_EQ(b.surface_force_samples, a.surface_force_samples);
}

TEST(Protocol, AnotherVersionIsRefused) {
  const std::string message = protocol::encode(protocol::Kind::done, protocol::version + 1);
  EXPECT_THAT(
      test::error_of([&] { protocol::kind_of(message); }),
      HasSubstr(fmt::format("protocol version {} against {}; build both again", protocol::version + 1, protocol::version)));
}

TEST(Protocol, GarbledAndMisplacedMessagesAreRefused) {
  const std::string good = protocol::encode(protocol::Checkpoint{"somewhere"});
  EXPECT_THAT(test::error_of([&] { protocol::kind_of(std::string_view(good).substr(0, good.size() / 2)); }),
              HasSubstr("cut short or garbled"));
  EXPECT_THAT(test::error_of([&] { protocol::kind_of("\x01"); }), HasSubstr("not of our protocol"));
  protocol::Failed other;
  EXPECT_THAT(test::error_of([&] { protocol::decode(good, other); }), HasSubstr("'checkpoint' came where 'failed' was due"));
}
