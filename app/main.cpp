// couloir: the command line. Verbs live in files of their own; only this one sets exit codes.
//
//   0 done   1 a check failed   2 the user's input is wrong   3 the run failed (its state is saved and named)   4 an engine
//   failed

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "app/verbs.hpp"
#include "continuum/errors.hpp"
#include "continuum/isa/isa.hpp"
#include "continuum/mesh/ranks.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/engine/engine_error.hpp"
#include "coupling/loop/interrupted.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/scene/scene_error.hpp"

namespace {

int fail(int code, const char* kind, const std::exception& error) {
  std::fprintf(stderr, "couloir: %s: %s\n", kind, error.what());
  std::fflush(stderr);
  couloir::Ranks::end_all(code);
  return code;
}

// CLI11 names neither the word nor what there is. True: it has been told.
bool unknown_verb(const CLI::App& app, const std::string& word) {
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == word) return false;
    verbs += verb->get_name() + ", ";
  }
  std::fprintf(stderr, "couloir: error in the input: there is no verb '%s'; there are %sand test at the front door ./couloir.\n",
               word.c_str(), verbs.c_str());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace couloir;
  CLI::App app{"Granular avalanches that hit obstacles: a depth-averaged flow coupled to discrete grains.", "couloir"};
  app.require_subcommand(1);
  app.footer("couloir test   builds and runs all tests (of the front door, see ./couloir)");
  int exit_code = 0;
  add_plan(app, exit_code);
  add_run(app, exit_code);
  add_report(app, exit_code);
  add_check(app, exit_code);
  add_study(app, exit_code);
  add_calibrate(app, exit_code);
  add_bench(app, exit_code);
  if (argc > 1 && argv[1][0] != '-' && unknown_verb(app, argv[1])) return 2;
  try {
    chosen_isa();  // a wrong COULOIR_ISA is told before anything is made
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const IsaError& error) {
    return fail(2, "error in the input", error);
  } catch (const SceneError& error) {
    return fail(2, "error in the input", error);
  } catch (const EngineError& error) {
    return fail(4, "the grain engine failed", error);
  } catch (const NumericsError& error) {
    return fail(3, "the run failed", error);
  } catch (const RecordError& error) {
    return fail(3, "the run failed", error);
  } catch (const Interrupted& error) {
    return fail(3, "interrupted", error);
  } catch (const Stopped& error) {
    return fail(3, "interrupted", error);
  } catch (const std::exception& error) {
    return fail(3, "internal error", error);
  }
}
