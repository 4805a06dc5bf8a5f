// The worker of the grain engine LIGGGHTS: serves one run, over the endpoint on its command line (coupling/engine/protocol.hpp).
// Rank 0 talks; each command is broadcast as it came, so that all ranks do the same.

#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <clocale>
#include <csignal>
#include <memory>
#include <thread>
#include <zmq.hpp>

#include "coupling/engine/protocol.hpp"
#include "coupling/workers/engine_errors.hpp"
#include "coupling/workers/liggghts_session.hpp"

namespace couloir {
namespace {

class Line {  // to the program; on other ranks than the first it says nothing
 public:
  Line(const char* endpoint, bool talks) : talks_(talks) {
    socket_.set(zmq::sockopt::linger, 1000);
    if (talks_) socket_.connect(endpoint);
  }
  void say(const std::string& message) {
    if (talks_) socket_.send(zmq::buffer(message), zmq::send_flags::none);
  }
  std::string listen() {
    zmq::message_t raw;
    while (!socket_.recv(raw, zmq::recv_flags::none)) {
    }
    return raw.to_string();
  }

 private:
  bool talks_;
  zmq::context_t context_{1};
  zmq::socket_t socket_{context_, zmq::socket_type::pair};
};

// The next command, on all ranks. Those that wait for the first rank sleep: the program may need their cores.
std::string next_command(Line& line, int rank, int ranks) {
  std::string message;
  if (rank == 0) message = line.listen();
  if (ranks == 1) return message;
  std::uint64_t size = message.size();
  MPI_Request request;
  MPI_Ibcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
  for (int there = 0;;) {
    MPI_Test(&request, &there, MPI_STATUS_IGNORE);
    if (there) break;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  message.resize(size);
  MPI_Bcast(message.data(), static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
  return message;
}

// Does one command; false: stop.
bool obey(const std::string& message, std::unique_ptr<Session>& session, Line& line) {
  const auto need_session = [&] {
    if (!session) throw EngineFailure("a command came before the start", true);
  };
  switch (protocol::kind_of(message)) {
    case protocol::Kind::start: {
      protocol::Start start;
      protocol::decode(message, start);
      if (session) throw EngineFailure("a second start came", true);
      session = std::make_unique<Session>(start.setup, start.restore, MPI_COMM_WORLD,
                                          [&line] { line.say(protocol::encode(protocol::Kind::heartbeat)); });
      line.say(protocol::encode(protocol::Started{session->engine_name()}));
      return true;
    }
    case protocol::Kind::advance: {
      need_session();
      AdvanceRequest request;
      protocol::decode(message, request);
      line.say(protocol::encode(session->advance(request)));
      return true;
    }
    case protocol::Kind::checkpoint: {
      need_session();
      protocol::Checkpoint checkpoint;
      protocol::decode(message, checkpoint);
      session->checkpoint(checkpoint.path);
      line.say(protocol::encode(protocol::Kind::done));
      return true;
    }
    case protocol::Kind::stop:
      return false;
    default:
      throw EngineFailure(std::string("the worker got a message '") + protocol::to_string(protocol::kind_of(message)) + "'",
                          true);
  }
}

void serve(const char* endpoint) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Line line(endpoint, rank == 0);
  line.say(protocol::encode(protocol::Hello{static_cast<int>(getpid())}));
  std::unique_ptr<Session> session;
  for (bool going = true; going;) {
    const std::string message = next_command(line, rank, ranks);
    try {
      going = obey(message, session, line);
    } catch (const std::exception& e) {
      const auto* failure = dynamic_cast<const EngineFailure*>(&e);
      if (rank != 0 && !(failure && failure->everywhere)) {  // the first rank does not know of it
        std::fprintf(stderr, "rank %d: %s\n", rank, e.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
      }
      line.say(protocol::encode(protocol::Failed{e.what(), failure && failure->runaway}));
      (void)session.release();  // an engine in the middle of things cannot be taken down; the process ends soon
    }
  }
}

}  // namespace
}  // namespace couloir

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: couloir_liggghts_worker ENDPOINT (started by couloir, not by hand)\n");
    return 2;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // under mpirun, too, no rank outlives it
  signal(SIGINT, SIG_IGN);           // Ctrl-C is the program's business
  setlocale(LC_ALL, "C");            // the engine reads numbers by the locale
  MPI_Init(&argc, &argv);
  couloir::serve(argv[1]);
  MPI_Finalize();
  return 0;
}
