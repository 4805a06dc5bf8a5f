#pragma once
// Reads RUN/records.h5 back: for comparisons, `reproduce`, continued runs and tests. All calls throw RecordError.
#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/records/h5.hpp"

namespace couloir {

// One frame as it was stored; empty vectors where the run had no continuum or no grains.
struct Frame {
  double time = 0;                      // [s]
  std::vector<double> h, hu, hv;        // [j * nx + i] [m], [m2/s]
  BlocksView blocks;                    // empty: all cells are of one size
  Grains grains;                        // tilted frame
  bool operator==(const Frame&) const;  // bit for bit
};

class RecordsReader {
 public:
  explicit RecordsReader(const std::string& path);

  std::string text(const std::string& attribute) const;  // of the root: "scene", "git_revision", "status", ...
  double number(const std::string& attribute) const;     // "bulk_density", "seed", ...
  bool has(const std::string& attribute) const;
  bool holds(const std::string& group) const;  // "measures", ...: older records have fewer
  Grid grid() const;                           // nx = 0: no continuum
  std::vector<double> bed() const;

  std::vector<long> frames() const;  // indices, rising
  Frame frame(long index) const;

  std::vector<double> window(const std::string& column) const;  // as in columns.hpp: "time", "mass_grains", ...
  std::vector<std::string> obstacles() const;
  std::vector<double> force(const std::string& obstacle, const std::string& column) const;  // "time", "fx", "fy", ...
  std::vector<std::string> gauges() const;
  std::vector<double> gauge(const std::string& name, const std::string& column) const;  // "time", "depth", "velocity_along", ...
  std::vector<ForceMeasure> measures() const;                                           // empty in records without any
  std::vector<std::string> planes() const;                                              // obstacles of method planes
  std::vector<double> planes(const std::string& obstacle, const std::string& column) const;  // "overflow", "heap" or "climbed"
  std::vector<double> measure(const ForceMeasure&, const std::string& column) const;         // "fx" or "fy"
  // [N] along the slope, many a window; none in continuum mode.
  std::vector<double> force_samples(const std::string& obstacle) const;
  // "<obstacle>/<gauge>" of each stress gauge; "normal", "up" or "across".
  std::vector<std::string> stress_gauges() const;
  std::vector<double> stress(const std::string& gauge, const std::string& column) const;
  std::vector<Event> events() const;

 private:
  h5::Handle file_;
};

}  // namespace couloir
