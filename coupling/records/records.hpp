#pragma once
// RUN/records.h5: everything a run tells its observers, in one file that explains itself. Layout (format version 1):
//
//   /                      attributes: format, format_version, provenance, scene, mode, seed, engine, start_time, status, ...
//   /surface/{x,angle,line}             the reference surface: arc length, inclination, points in the level frame
//   /grid/{x,y,bed,nodes}               cell centres, bed by cell, cell corners on the reference surface in the level frame
//   /obstacles/<name>                   attributes: footprint and height
//   /obstacles/<name>/triangles         of an obstacle of shape mesh
//   /effects/{name,on,reason}
//   /frames/<000000>/{time,h,hu,hv,surface,velocity,zone}
//   /frames/<000000>/blocks/{level,i0,j0,nx,ny,h,hu,hv}                   where cells are refined: all blocks
//   /frames/<000000>/planes/<front|back|left|right|top>/{a,b,h,ha,hb}     an obstacle of method planes
//   /frames/<000000>/grains/{id,x,y,z,vx,vy,vz,radius,driven,position,velocity}
//   /windows/{time,length,mass_*,momentum_*,grains,...}    one row a window
//   /forces/<obstacle>/{time,fx,fy,fz,depth_on_top}        one row a window
//   /planes/<obstacle>/{overflow,heap,climbed}             one row a window, of an obstacle of method planes
//   /gauges/<name>/{time,depth,velocity_along,velocity_across}    one row a window
//   /stresses/<obstacle>/<gauge>/{normal,up,across}        one row a window; attribute: area
//   /measures/<kind>/<of>/{fx,fy}                          one row a window: force by other measures, force_measures.hpp
//   /force_samples/<obstacle>/fx                          many rows a window (attribute: interval), from the start on: what is
//                                                          in the force above the windows' frequency. 64 kB a second and obstacle
//                                                          before compression, at eight samples of windows of 1 ms
//   /events/{time,text}
//
// Numbers that a run is compared by (h, hu, hv, x, vx, ...) are stored as computed, in double; `surface`, `position` and
// `velocity` are float copies in the level frame (X horizontal, Z up) for pictures. Every dataset has `unit` and `description`.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/records/h5.hpp"
#include "coupling/records/undo_journal.hpp"

namespace couloir {

// How the program was started, and which one it is. Threads and ranks change no bit.
struct Started {
  std::string build;  // build_identity (provenance.hpp)
  int threads = 1, ranks = 1;
};

class Records : public Observer {
 public:
  static constexpr int kFormatVersion = 1;

  // `scene_text`: the scene as run, complete (write_scene). `checkpoints`: their folder, empty where there are none. `resumed`:
  // state() will open the file of an earlier process. Throws RecordError.
  Records(const std::string& path, const std::string& scene_text, const std::string& checkpoints = "", bool resumed = false,
          Started started = {});
  ~Records() override;
  void on_start(const RunStart&) override;
  void on_window(const WindowReport&) override;  // kept in memory until the next frame, or for 256 windows
  void on_frame(const FrameView&) override;      // ends with a flush to disk
  void on_event(const Event&) override;
  void state(Archive&) override;  // the file itself is the state: loading rolls it back
  void on_checkpoint(std::int64_t number) override;
  void on_resume(const Resumption&) override;
  void on_finish(const RunEnd&) override;

 private:
  struct ForceColumns {
    h5::Series time, fx, fy, fz, depth_on_top;
  };
  struct PlanesColumns {
    h5::Series overflow, heap, climbed;
  };
  struct MeasureColumns {
    h5::Series fx, fy;
  };

  struct StressColumns {
    h5::Series normal, up, across;
  };
  struct GaugeColumns {
    h5::Series time, depth, along, across;
  };

  void guarded(const std::function<void()>& write);
  void write_root(const Scene&, double bulk_density);
  void write_surface();
  void write_grid(const RunStart&);
  void write_flow(hid_t frame, const FrameView&);
  void write_blocks(hid_t frame, const BlocksView&);
  void write_planes(hid_t frame, const std::vector<PlaneView>&);
  void write_grains(hid_t frame, const Grains&);
  void open_series();
  void close();
  void write_waiting();

  std::string path_, scene_text_, checkpoints_;
  Started started_;
  bool failed_ = false;
  RunStart start_;
  const ReferenceSurface* surface_ = nullptr;
  Grid grid_;
  std::vector<double> bed_;
  double thin_ = 0;  // [m] up to it frames show no velocity
  long waiting_ = 0;
  std::uint64_t settled_ = 0;  // [bytes] of the file at the last checkpoint
  UndoJournal journal_;        // outlives the file
  h5::Handle file_, frames_;
  std::vector<h5::Series> columns_;  // as window_columns()
  std::vector<ForceColumns> forces_;
  std::vector<h5::Series> samples_;  // by obstacle; none without grains
  int planes_obstacle_ = -1;         // number
  std::optional<PlanesColumns> planes_;
  std::vector<GaugeColumns> gauges_;
  std::vector<MeasureColumns> measures_;
  std::vector<StressColumns> stresses_;
  std::optional<h5::Series> event_time_;
  std::optional<h5::TextSeries> event_text_;
};

}  // namespace couloir
