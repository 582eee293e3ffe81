// SPDX-License-Identifier: MIT
// What compile_library made of the Lua half of the library, as read-only data of the program: nothing to find, to copy
// or to be damaged beside it, and the processes of a sweep share its pages.

asm(".section .rodata\n"
    ".balign 16\n"
    ".global tunica_library_begin, tunica_library_end\n"
    "tunica_library_begin:\n"
    ".incbin \"" TUNICA_LIBRARY_BYTECODE
    "\"\n"
    "tunica_library_end:\n"
    ".byte 0\n"
    ".previous\n");
