#pragma once
// Measured figures beside what theory says, printed; COULOIR_CONTACTS=FOLDER also keeps them in FOLDER/contacts.csv, from which
// figures.py makes the table and the picture of docs/results/contacts.md.

#include <cstdio>
#include <cstdlib>
#include <string>

namespace couloir::test {

inline void figure(const std::string& check, const std::string& engine, const std::string& law, double at, double measured,
                   double theory) {
  std::printf("%-28s %-9s %-13s %12.6g  measured %-12.6g theory %-12.6g\n", check.c_str(), engine.c_str(), law.c_str(), at,
              measured, theory);
  const char* folder = std::getenv("COULOIR_CONTACTS");
  if (!folder) return;
  if (FILE* out = std::fopen((std::string(folder) + "/contacts.csv").c_str(), "a")) {
    std::fprintf(out, "%s,%s,%s,%.9g,%.9g,%.9g\n", check.c_str(), engine.c_str(), law.c_str(), at, measured, theory);
    std::fclose(out);
  }
}

}  // namespace couloir::test
