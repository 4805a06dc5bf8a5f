#include "coupling/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "app/verbs.hpp"
#include "coupling/calibration/material_file.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/loop/engine_setup.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/records/console.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/calibration_name.hpp"
#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double usual_diameter = 0.004;  // [m] where neither the material nor the scene has one

constexpr double least_diameter = 1e-5, most_diameter = 1;  // [m] beyond, a number without its unit is more likely meant

struct CalibrateVerb {
  std::string material, engine, out, diameter;
  int replicates = 3, jobs = 0;
  bool quick = false, json = false, record_only = false;
};

struct Subject {
  Scene scene;       // its material and grains count
  std::string file;  // of the material; empty: inline in a scene
  std::string name;  // of record and folder
};

// A material by name, or a scene whose material and grains are meant.
Subject subject_of(const CalibrateVerb& verb) {
  Subject s;
  std::error_code error;
  const bool by_scene = fs::exists(verb.material, error);
  if (by_scene) {
    s.scene = read_scene(verb.material, materials_folder());
  } else if (verb.material.find('/') != std::string::npos || verb.material.ends_with(".yaml")) {
    throw SceneError(verb.material + ": there is no such file or folder; give a scene, or a material's name");
  } else {
    s.scene.material = read_material(verb.material, materials_folder());
    s.scene.grains.diameter = s.scene.material.diameter > 0 ? s.scene.material.diameter : usual_diameter;
    if (double& modulus = s.scene.material.grain.youngs_modulus; modulus == 0) modulus = PackingSpec().youngs_modulus;
  }
  const Material& m = s.scene.material;
  s.name = m.name.empty() ? fs::path(verb.material).stem().string() : m.name;
  const std::string file = fmt::format("{}/{}.yaml", materials_folder(), s.name);
  if (fs::exists(file, error)) {
    if (!by_scene || s.scene.places.of("material.density").starts_with(file))
      s.file = file;
    else  // the scene's own material, which only has the name of one that is kept: not to be taken for it
      s.name = fs::absolute(verb.material).parent_path().filename().string() + "-" + s.name;
  }
  if (!verb.engine.empty()) s.scene.grains.engine = verb.engine;
  if (!verb.diameter.empty()) {
    try {
      s.scene.grains.diameter = parse_quantity(verb.diameter, Dimension::length);
    } catch (const QuantityError& problem) {
      throw SceneError(fmt::format("--diameter {}", problem.what()));
    }
  }
  if (!(s.scene.grains.diameter > 0))
    throw SceneError(fmt::format("{}: the grains have no diameter above 0; give one, as in --diameter '4 mm'", verb.material));
  if (s.scene.grains.diameter < least_diameter || s.scene.grains.diameter > most_diameter)
    throw SceneError(
        fmt::format("{}: grains of {:g} mm are beyond what is calibrated, {:g} to {:g} mm; give another diameter, as in "
                    "--diameter '4 mm'",
                    verb.material, 1e3 * s.scene.grains.diameter, 1e3 * least_diameter, 1e3 * most_diameter));
  if (!(m.delta > 0) || !(m.phi > 0))
    throw SceneError(fmt::format(
        "{}: the material {} has no measured angles to calibrate for: give it basal_friction_angle and internal_friction_angle "
        "above 0 deg, as a shear test or a reference has them",
        s.file.empty() ? verb.material : s.file, s.name));
  return s;
}

CalibrationTask task_of(const CalibrateVerb& verb, const Subject& s) {
  const Material& m = s.scene.material;
  CalibrationTask task;
  task.material = s.name;
  task.source = m.source.substr(0, m.source.find(" Grain parameters:"));
  task.delta = m.delta;
  task.phi = m.phi;
  task.quick = verb.quick;
  task.plan = verb.quick ? SlabPlan::quick(verb.replicates) : SlabPlan::full(verb.replicates);
  const PackingSpec settled;  // the blocks settle with its frictions, whatever the scene's
  task.stock = packing_spec(s.scene, 0);
  task.stock.friction = settled.friction;
  task.stock.base_friction = settled.base_friction;
  task.stock.rolling_friction = settled.rolling_friction;
  task.stock.base_rolling_friction = settled.base_rolling_friction;
  return task;
}

fs::path folder_of(const CalibrateVerb& verb, const std::string& name) {
  const fs::path folder = verb.out.empty() ? fs::path("runs") / ("calibrate-" + name) : fs::path(verb.out);
  std::error_code error;
  if (fs::exists(folder, error) &&
      !(fs::is_directory(folder, error) && (fs::is_empty(folder, error) || fs::exists(folder / "measurements.jsonl"))))
    throw SceneError(folder.string() + " is not empty and no folder of a calibration; choose another --out");
  fs::create_directories(folder, error);
  if (error) throw SceneError(fmt::format("{} cannot be made: {}; choose another --out", folder.string(), error.message()));
  return folder;
}

// That ends with one newline, which write_atomically adds.
void write_lines(const std::string& path, const std::string& lines) {
  write_atomically(path, lines.substr(0, lines.find_last_not_of('\n') + 1));
}

// Into dem_inputs, with the values in the material's own file. Returns what was written.
std::string keep(const CalibrationRecord& record, const std::string& text, const Subject& s, bool values) {
  const fs::path folder = fs::path(materials_folder()).parent_path() / "calibrations";
  fs::create_directories(folder);
  const std::string name = calibration_name(s.name, s.scene.grains.engine, record.contact, record.rotation, record.diameter);
  const std::string path = (folder / (name + ".yaml")).string();
  write_lines(path, text);
  if (!values) return path;
  write_lines(s.file, with_calibration(read_text(s.file), record, name));
  return path + " and " + s.file;
}

int calibrate_material(const CalibrateVerb& verb) {
  const Subject subject = subject_of(verb);
  const CalibrationTask task = task_of(verb, subject);
  const fs::path folder = folder_of(verb, subject.name);
  std::FILE* const screen = verb.json ? stderr : stdout;
  note_stop_signals();

  MeasurementSettings settings;
  settings.engine = subject.scene.grains.engine;
  settings.worker = worker_path(settings.engine);
  settings.file = (folder / "measurements.jsonl").string();
  settings.made_by = provenance().revision;
  settings.packings = packings_folder();
  settings.work_dir = fs::absolute(folder).string();
  settings.jobs = jobs_or_cores(verb.jobs);
  settings.stop = told_to_stop;
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  settings.on_measurement = [&](std::size_t made) {
    if (made % 5 == 0) fmt::print(screen, "  {} slabs measured, {}\n", made, in_words(seconds()));
    std::fflush(screen);
  };
  Measurements measurements(settings);
  const auto say = [&](const std::string& line) {
    fmt::print(screen, "{}\n", line);
    std::fflush(screen);
  };
  CalibrationRecord record;
  try {
    record = calibrate(
        task, [&](const auto& slabs) { return measurements.measure(slabs); }, say);
  } catch (const Stopped&) {
    fmt::print(stderr, "couloir: interrupted; {} measurements were made and are in {}; the same command goes on\n",
               measurements.made(), settings.file);
    return 3;
  }

  record.rotation = rotation_name(subject.scene.grains);
  const std::string text = write_calibration(record);
  std::string written = (folder / "calibration.yaml").string();
  write_lines(written, text);
  // A quick one is too coarse for scenes.
  if (!verb.quick && !subject.file.empty()) written += ", " + keep(record, text, subject, !verb.record_only);
  if (verb.json) {
    const auto angle = [](const CalibratedAngle& a) {
      return nlohmann::ordered_json{{"asked", a.asked}, {"reached", a.reached}, {"uncertainty", a.uncertainty}, {"met", a.met}};
    };
    const nlohmann::ordered_json out{{"material", record.material},
                                     {"delta", angle(record.delta)},
                                     {"phi", angle(record.phi)},
                                     {"friction", record.grains.friction},
                                     {"rolling_friction", record.grains.rolling_friction},
                                     {"base_friction", record.grains.base_friction},
                                     {"base_rolling_friction", record.grains.base_rolling_friction},
                                     {"notes", record.notes},
                                     {"record", (folder / "calibration.yaml").string()}};
    fmt::print("{}\n", out.dump(2));
    return 0;
  }
  fmt::print("\n{} of {:g} mm: delta {:.2f} +- {:.2f} deg of {:.2f}, phi {:.2f} +- {:.2f} deg of {:.2f}\n{}", record.material,
             1000 * record.diameter, record.delta.reached, record.delta.uncertainty, record.delta.asked, record.phi.reached,
             record.phi.uncertainty, record.phi.asked, grains_block(record));
  for (const std::string& note : record.notes) fmt::print("note: {}\n", note);
  fmt::print("written: {}\n", written);
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CalibrateVerb>();
  CLI::App* verb = app.add_subcommand("calibrate", "find grain frictions that show a material's measured angles phi and delta");
  verb->add_option("MATERIAL", options->material,
                   "a name in dem_inputs/materials, or a scene (file or folder) whose material and grains are meant")
      ->required();
  verb->add_option("--diameter", options->diameter, "of the grains, as in '4 mm'; default: the scene's or the material's");
  verb->add_option("--engine", options->engine, "liggghts or yade; default: the scene's, or liggghts")
      ->check(CLI::IsMember({"liggghts", "yade"}));
  verb->add_option("--replicates", options->replicates, "slabs from other seeds, for the uncertainty; default 3")
      ->check(CLI::Range(1, 100));
  verb->add_flag("--quick", options->quick, "small slabs and coarse searches; writes nothing into dem_inputs");
  verb->add_flag("--record-only", options->record_only, "leave the material's own file as it is");
  verb->add_option("--jobs", options->jobs, "slabs at a time; default: as many as there are cores")->check(CLI::Range(1, 256));
  verb->add_option("--out", options->out, "folder of what was measured; default: runs/calibrate-<material>");
  verb->add_flag("--json", options->json, "print the result alone, machine-readable");
  verb->callback([options, &exit_code] { exit_code = calibrate_material(*options); });
}

}  // namespace couloir
