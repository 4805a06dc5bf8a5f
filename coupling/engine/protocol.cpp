#include "coupling/engine/protocol.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>
#include <msgpack.hpp>
#include <type_traits>

#include "coupling/engine/engine_error.hpp"

namespace couloir::protocol {

static_assert(std::endian::native == std::endian::little, "blocks of numbers are sent as they lie in memory");

namespace {

// Sent as one block of bytes: numbers, and structures of nothing but doubles.
template <class T>
inline constexpr bool is_block = std::is_arithmetic_v<T> || std::is_same_v<T, Vec> || std::is_same_v<T, Triangle>;
static_assert(sizeof(Triangle) == 9 * sizeof(double));

// The fields of each structure, listed once for both directions.
template <class A>
void fields(A& a, Bend& s) {
  a(s.begin, s.length, s.foot, s.centre);
}
template <class A>
void fields(A& a, DriveFace& s) {
  a(s.origin, s.inward, s.along, s.segment_width, s.segments, s.strip_begin, s.strip_end, s.bend);
}
template <class A>
void fields(A& a, EngineSurface& s) {
  a(s.name, s.triangles, s.friction, s.rolling_friction);
}
template <class A>
void fields(A& a, LinearContact& s) {
  a(s.stiffness, s.shear_stiffness, s.damping, s.shear_damping, s.surface_damping, s.surface_shear_damping);
}
template <class A>
void fields(A& a, RotationControl& s) {
  a(s.retarding_time, s.contact_influence, s.shear_influence, s.slide_to_roll, s.roll_to_slide);
}
template <class A>
void fields(A& a, EngineSetup& s) {
  a(s.timestep, s.gravity, s.lo, s.hi, s.periodic, s.density, s.max_radius, s.skin, s.friction, s.rolling_friction, s.restitution,
    s.youngs_modulus, s.poisson_ratio, s.contact, s.linear, s.rotation, s.control, s.surfaces, s.faces, s.ranks, s.timeout,
    s.work_dir, s.tangential_damping);
}
template <class A>
void fields(A& a, NewGrain& s) {
  a(s.id, s.position, s.velocity, s.radius, s.face, s.segment, s.spin);
}
template <class A>
void fields(A& a, SegmentDrive& s) {
  a(s.push, s.most, s.least, s.along, s.least_mass, s.exit_active, s.exit_velocity, s.slide);
}
template <class A>
void fields(A& a, Regrouped& s) {
  a(s.id, s.face, s.segment);
}
template <class A>
void fields(A& a, RimMove& s) {
  a(s.faces, s.driven);
}
template <class A>
void fields(A& a, AdvanceRequest& s) {
  a(s.steps, s.insert, s.remove, s.drives, s.want_grains, s.rim_moves, s.sample_steps);
}
template <class A>
void fields(A& a, SegmentReport& s) {
  a(s.displacement, s.velocity, s.force, s.mass);
}
template <class A>
void fields(A& a, Grains& s) {
  a(s.id, s.x, s.y, s.z, s.vx, s.vy, s.vz, s.radius, s.driven);
}
template <class A>
void fields(A& a, Advanced& s) {
  a(s.step, s.grains, s.surface_force, s.surface_force_last, s.segments, s.drive_impulse, s.kinetic_energy, s.max_overlap, s.cpu,
    s.zone_force, s.surface_force_samples);
}
template <class A>
void fields(A& a, Hello& s) {
  a(s.pid);
}
template <class A>
void fields(A& a, Start& s) {
  a(s.setup, s.restore);
}
template <class A>
void fields(A& a, Started& s) {
  a(s.engine);
}
template <class A>
void fields(A& a, Checkpoint& s) {
  a(s.path);
}
template <class A>
void fields(A& a, Failed& s) {
  a(s.reason, s.runaway);
}

class Packer {
 public:
  explicit Packer(msgpack::sbuffer& buffer) : pack_(buffer) {}

  template <class... F>
  void operator()(F&... field) {
    pack_.pack_array(sizeof...(F));
    (put(field), ...);
  }
  template <class T>
  void put(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      pack_.pack(value);
    } else if constexpr (std::is_enum_v<T>) {
      pack_.pack(static_cast<int>(value));
    } else {
      fields(*this, value);
    }
  }
  template <class T, std::size_t n>
  void put(std::array<T, n>& values) {
    pack_.pack_array(n);
    for (T& value : values) put(value);
  }
  template <class T>
  void put(std::vector<T>& values) {
    if constexpr (is_block<T>) {
      const std::size_t bytes = values.size() * sizeof(T);
      if (bytes > std::numeric_limits<std::uint32_t>::max()) throw EngineError("a message to the grain engine is over 4 GB");
      pack_.pack_bin(static_cast<std::uint32_t>(bytes));
      pack_.pack_bin_body(reinterpret_cast<const char*>(values.data()), static_cast<std::uint32_t>(bytes));
    } else {
      pack_.pack_array(static_cast<std::uint32_t>(values.size()));
      for (T& value : values) put(value);
    }
  }

 private:
  msgpack::packer<msgpack::sbuffer> pack_;
};

class Unpacker {
 public:
  explicit Unpacker(const msgpack::object& at) : at_(&at) {}

  template <class... F>
  void operator()(F&... field) {
    const msgpack::object* item = items(sizeof...(F));
    (get(*item++, field), ...);
  }
  template <class T>
  static void get(const msgpack::object& object, T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      object.convert(value);
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(object.as<int>());
    } else {
      Unpacker inner(object);
      fields(inner, value);
    }
  }
  template <class T, std::size_t n>
  static void get(const msgpack::object& object, std::array<T, n>& values) {
    const msgpack::object* item = Unpacker(object).items(n);
    for (T& value : values) get(*item++, value);
  }
  static void get(const msgpack::object& object, std::array<bool, 3>& values) {
    const msgpack::object* item = Unpacker(object).items(3);
    for (bool& value : values) value = (item++)->as<bool>();
  }
  template <class T>
  static void get(const msgpack::object& object, std::vector<T>& values) {
    if constexpr (is_block<T>) {
      if (object.type != msgpack::type::BIN || object.via.bin.size % sizeof(T) != 0) throw msgpack::type_error();
      values.resize(object.via.bin.size / sizeof(T));
      if (!values.empty()) std::memcpy(values.data(), object.via.bin.ptr, object.via.bin.size);
    } else {
      if (object.type != msgpack::type::ARRAY) throw msgpack::type_error();
      values.resize(object.via.array.size);
      for (std::size_t i = 0; i < values.size(); ++i) get(object.via.array.ptr[i], values[i]);
    }
  }

 private:
  const msgpack::object* items(std::size_t count) const {
    if (at_->type != msgpack::type::ARRAY || at_->via.array.size != count) throw msgpack::type_error();
    return at_->via.array.ptr;
  }
  const msgpack::object* at_;
};

template <class Body>
std::string pack(Kind kind, const Body& body) {
  msgpack::sbuffer buffer;
  msgpack::packer<msgpack::sbuffer> head(buffer);
  head.pack_array(3).pack(version).pack(static_cast<int>(kind));
  Packer packer(buffer);
  packer.put(const_cast<Body&>(body));  // fields() takes both directions; packing only reads
  return std::string(buffer.data(), buffer.size());
}

// Bytes stay where they are: nothing is copied before it reaches its vector.
bool by_reference(msgpack::type::object_type, std::size_t, void*) {
  return true;
}

msgpack::object_handle parse(std::string_view message, Kind& kind) {
  try {
    msgpack::object_handle handle = msgpack::unpack(message.data(), message.size(), by_reference);
    const msgpack::object& top = handle.get();
    if (top.type != msgpack::type::ARRAY || top.via.array.size < 2) throw msgpack::type_error();
    const int spoken = top.via.array.ptr[0].as<int>();
    if (spoken != version) {
      throw EngineError(
          fmt::format("the grain engine's worker and this program come from different builds: protocol version {} "
                      "against {}; build both again from the same sources",
                      spoken, version));
    }
    kind = static_cast<Kind>(top.via.array.ptr[1].as<int>());
    return handle;
  } catch (const msgpack::unpack_error&) {
    throw EngineError("a message between the program and the grain engine's worker cannot be read: it is cut short or garbled");
  } catch (const msgpack::type_error&) {
    throw EngineError("a message between the program and the grain engine's worker cannot be read: it is not of our protocol");
  }
}

template <class Body>
void unpack(std::string_view message, Kind expected, Body& body) {
  Kind kind{};
  const msgpack::object_handle handle = parse(message, kind);
  if (kind != expected) {
    throw EngineError(fmt::format("the grain engine's worker and the program are out of step: '{}' came where '{}' was due",
                                  to_string(kind), to_string(expected)));
  }
  try {
    if (handle.get().via.array.size != 3) throw msgpack::type_error();
    Unpacker::get(handle.get().via.array.ptr[2], body);
  } catch (const msgpack::type_error&) {
    throw EngineError(
        fmt::format("a message '{}' between the program and the grain engine's worker has the wrong fields", to_string(kind)));
  }
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::hello:
      return "hello";
    case Kind::start:
      return "start";
    case Kind::started:
      return "started";
    case Kind::advance:
      return "advance";
    case Kind::checkpoint:
      return "checkpoint";
    case Kind::stop:
      return "stop";
    case Kind::done:
      return "done";
    case Kind::heartbeat:
      return "heartbeat";
    case Kind::advanced:
      return "advanced";
    case Kind::failed:
      return "failed";
  }
  return "unknown";
}

Kind kind_of(std::string_view message) {
  Kind kind{};
  parse(message, kind);
  return kind;
}

std::string encode(Kind kind, int version) {
  msgpack::sbuffer buffer;
  msgpack::packer<msgpack::sbuffer> head(buffer);
  head.pack_array(2).pack(version).pack(static_cast<int>(kind));
  return std::string(buffer.data(), buffer.size());
}

std::string encode(const Hello& body) {
  return pack(Kind::hello, body);
}
std::string encode(const Start& body) {
  return pack(Kind::start, body);
}
std::string encode(const Started& body) {
  return pack(Kind::started, body);
}
std::string encode(const AdvanceRequest& body) {
  return pack(Kind::advance, body);
}
std::string encode(const Checkpoint& body) {
  return pack(Kind::checkpoint, body);
}
std::string encode(const Advanced& body) {
  return pack(Kind::advanced, body);
}
std::string encode(const Failed& body) {
  return pack(Kind::failed, body);
}

void decode(std::string_view message, Hello& body) {
  unpack(message, Kind::hello, body);
}
void decode(std::string_view message, Start& body) {
  unpack(message, Kind::start, body);
}
void decode(std::string_view message, Started& body) {
  unpack(message, Kind::started, body);
}
void decode(std::string_view message, AdvanceRequest& body) {
  unpack(message, Kind::advance, body);
}
void decode(std::string_view message, Checkpoint& body) {
  unpack(message, Kind::checkpoint, body);
}
void decode(std::string_view message, Advanced& body) {
  unpack(message, Kind::advanced, body);
}
void decode(std::string_view message, Failed& body) {
  unpack(message, Kind::failed, body);
}

}  // namespace couloir::protocol
