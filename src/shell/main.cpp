// SPDX-License-Identifier: MIT
#include <malloc.h>

#include "shell/program.h"

int main(int argc, char** argv) {
  // Snapshots and tables are larger than what malloc returns to the system at once, and each page that comes back must
  // be cleared again: memory once used is kept.
  mallopt(M_MMAP_THRESHOLD, 1 << 28);
  mallopt(M_TRIM_THRESHOLD, 1 << 28);
  return tunica::shell::run_program(argc, argv);
}
