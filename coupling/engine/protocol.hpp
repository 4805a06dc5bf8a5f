#pragma once
// What the program and a grain engine's worker say to each other. One message is one msgpack array
//
//   [protocol version, kind, body]
//
// where a structure is an array of its fields in the order of their declaration and a long vector of numbers is one block of
// little-endian bytes. Each command gets one answer; heartbeats may come before it.
//
//   program                       worker
//                     <- hello            once connected
//   start           ->
//                     <- started
//   advance         ->
//                     <- heartbeat        while it works
//                     <- advanced
//   checkpoint      ->
//                     <- done
//   stop            ->                    the worker ends
//
// Any command may be answered by `failed`; the worker is then good for `stop` only.

#include <string>
#include <string_view>

#include "coupling/engine/grain_engine.hpp"

namespace couloir::protocol {

inline constexpr int version = 9;

enum class Kind : int { hello, start, started, advance, checkpoint, stop, done, heartbeat, advanced, failed };
const char* to_string(Kind);

struct Hello {
  int pid = 0;  // of the worker's first rank
};

struct Start {
  EngineSetup setup;
  std::string restore;  // a checkpoint to go on from; empty: start anew
};

struct Started {
  std::string engine;  // name and version
};

struct Checkpoint {
  std::string path;
};

struct Failed {
  std::string reason;    // the engine's own words
  bool runaway = false;  // RunawayError
};

// The kind of a message. Throws EngineError where it was written by another version of this protocol, or is no message.
Kind kind_of(std::string_view message);

// A message of a kind without a body: stop, done, heartbeat. `version` differs from ours in tests only.
std::string encode(Kind, int version = protocol::version);

std::string encode(const Hello&);
std::string encode(const Start&);
std::string encode(const Started&);
std::string encode(const AdvanceRequest&);
std::string encode(const Checkpoint&);
std::string encode(const Advanced&);
std::string encode(const Failed&);

// Each throws EngineError where the message is of another kind or its body does not fit.
void decode(std::string_view message, Hello&);
void decode(std::string_view message, Start&);
void decode(std::string_view message, Started&);
void decode(std::string_view message, AdvanceRequest&);
void decode(std::string_view message, Checkpoint&);
void decode(std::string_view message, Advanced&);
void decode(std::string_view message, Failed&);

}  // namespace couloir::protocol
