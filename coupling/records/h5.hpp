#pragma once
// The little of HDF5 that the records need: owned identifiers, datasets with unit and description, series that grow.

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupling/records/record_error.hpp"
#include "coupling/records/undo_journal.hpp"

namespace couloir::h5 {

// What the numbers of a dataset are. Every dataset carries both as attributes.
struct Meaning {
  std::string unit;         // "m", "kg", "1" for pure numbers, "" for text
  std::string description;  // one sentence
};

// An identifier that is given back when the object dies.
class Handle {
 public:
  Handle() = default;
  // Takes `id`; a negative one is an error: throws RecordError with what HDF5 and the system say.
  Handle(hid_t id, const std::string& doing);
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = H5I_INVALID_HID; }
  Handle& operator=(Handle&& other) noexcept;
  operator hid_t() const { return id_; }
  bool empty() const { return id_ < 0; }
  void reset() noexcept;

 private:
  hid_t id_ = H5I_INVALID_HID;
};

// Before the first call of HDF5: it prints no errors of its own, and leaves what is open at the program's end alone.
void set_up_library();

// Throws RecordError where `status` is negative. `doing` reads "runs/a/records.h5 could not be written".
void check(herr_t status, const std::string& doing);

// A file whose metadata reach the disk only in flush(); what is written over goes through the journal, which must outlive it.
Handle create_file(const std::string& path, UndoJournal&);
Handle open_file(const std::string& path, UndoJournal&);
Handle create_file(const std::string& path);
Handle open_file(const std::string& path);  // for reading alone
void flush(hid_t file, const std::string& path);

Handle create_group(hid_t parent, const std::string& name);  // or opens it
Handle open_group(hid_t parent, const std::string& name);    // for reading: throws RecordError where there is none
bool exists(hid_t parent, const std::string& name);
std::vector<std::string> children(hid_t parent);  // names in alphabetical order

void put_attribute(hid_t object, const std::string& name, const std::string& value);
void put_attribute(hid_t object, const std::string& name, double value);
void put_attribute(hid_t object, const std::string& name, std::int64_t value);
void put_attributes(hid_t object, const std::vector<std::pair<std::string, std::string>>& texts);
bool has_attribute(hid_t object, const std::string& name);
std::string text_attribute(hid_t object, const std::string& name);
double number_attribute(hid_t object, const std::string& name);

template <class T>
hid_t type_of();
template <>
inline hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t type_of<std::int8_t>() {
  return H5T_NATIVE_INT8;
}

using Shape = std::vector<hsize_t>;  // slowest index first; empty: one number

// A whole array at once; chunked and deflated (level 1) where it is large enough to gain.
void put(hid_t parent, const std::string& name, hid_t type, const void* data, const Shape& shape, const Meaning& meaning);
template <class T>
void put(hid_t parent, const std::string& name, const std::vector<T>& data, const Shape& shape, const Meaning& meaning) {
  put(parent, name, type_of<T>(), data.data(), shape, meaning);
}

std::vector<double> numbers(hid_t parent, const std::string& name);  // any numeric dataset, flattened
std::vector<std::int64_t> integers(hid_t parent, const std::string& name);
std::vector<std::string> texts(hid_t parent, const std::string& name);
Shape shape_of(hid_t parent, const std::string& name);

// A column that grows row by row. Rows wait in memory until write().
class Series {
 public:
  Series(hid_t parent, const std::string& name, const Meaning& meaning);
  void add(double value) { waiting_.push_back(value); }
  void write();
  std::size_t waiting() const { return waiting_.size(); }

 private:
  hsize_t rows_ = 0;  // before set_, whose making fills it in
  Handle set_;
  std::vector<double> waiting_;
};

// The same for text.
class TextSeries {
 public:
  TextSeries(hid_t parent, const std::string& name, const Meaning& meaning);
  void add(const std::string& value) { waiting_.push_back(value); }
  void write();

 private:
  hsize_t rows_ = 0;  // before set_, whose making fills it in
  Handle set_;
  std::vector<std::string> waiting_;
};

}  // namespace couloir::h5
