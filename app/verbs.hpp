#pragma once
// One function a verb: declares its options and what to do when it is called. `exit_code` is what main returns.

namespace CLI {
class App;
}

namespace couloir {

void add_plan(CLI::App&, int& exit_code);
void add_run(CLI::App&, int& exit_code);
void add_resume(CLI::App&, int& exit_code);
void add_reproduce(CLI::App&, int& exit_code);
void add_report(CLI::App&, int& exit_code);
void add_check(CLI::App&, int& exit_code);
void add_study(CLI::App&, int& exit_code);
void add_advise(CLI::App&, int& exit_code);
void add_calibrate(CLI::App&, int& exit_code);
void add_bench(CLI::App&, int& exit_code);

}  // namespace couloir
