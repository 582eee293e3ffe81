// SPDX-License-Identifier: MIT
#include "shell/program.h"

int main(int argc, char** argv) { return tunica::shell::run_program(argc, argv); }
