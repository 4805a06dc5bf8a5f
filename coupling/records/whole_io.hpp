#pragma once
// Reads and writes that go on until all is done; errno says why where they fail.

#include <cstddef>
#include <cstdint>

namespace couloir {

// Bytes read, fewer at the file's end; -1: failed.
std::int64_t read_whole(int file, void* data, std::size_t count, std::uint64_t at);
bool write_whole(int file, const void* data, std::size_t count, std::uint64_t at);
// At the present place; what a failure has left there is taken back.
bool append_whole(int file, const void* data, std::size_t count);

}  // namespace couloir
