#pragma once
// Measurements that are kept: each is made once, by several workers at a time, and stands in a file for the next call.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "coupling/calibration/slab.hpp"

namespace couloir {

struct MeasurementSettings {
  std::string engine = "liggghts";
  std::string worker;                                    // program of the engine's worker
  std::string file;                                      // one measurement a line (JSON); made where it is missing
  std::string made_by;                                   // lines of another one are not used: the program's revision
  std::string packings;                                  // folder of settled blocks, as settled_packing
  std::string work_dir;                                  // must exist; a folder a measurement is made in it and removed
  int jobs = 1;                                          // measurements at a time
  std::function<bool()> stop = [] { return false; };     // asked often; true: ends with Stopped
  std::function<void(std::size_t made)> on_measurement;  // by any thread, one at a time
};

class Measurements {
 public:
  // Reads the file; lines that are damaged are dropped. Throws RecordError where it cannot be written.
  explicit Measurements(MeasurementSettings);

  // The curves of these, in their order; those that are missing are made. Throws EngineError, RecordError, Stopped: what was made
  // until then is kept.
  std::vector<SlabCurve> measure(const std::vector<SlabSpec>&);
  std::size_t made() const { return made_; }  // since the start

 private:
  std::string key(const SlabSpec&) const;

  MeasurementSettings settings_;
  std::map<std::string, SlabCurve> kept_;  // by key
  std::size_t made_ = 0;
};

}  // namespace couloir
