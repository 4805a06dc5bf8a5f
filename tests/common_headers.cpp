// The headers that most tests include are read once (tests/CMakeLists.txt); a precompiled header needs a source to belong to.
