#pragma once
// Bytes that the program holds by new: counted by the operators that heap_bytes.cpp puts in the place of the standard ones.

namespace couloir::bench {

long heap_bytes();

}  // namespace couloir::bench
