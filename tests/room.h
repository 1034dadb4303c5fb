/* SPDX-License-Identifier: MIT
 *
 * room.h - gives main() of a test the name TEST_MAIN; room.c calls it. -Dmain=… would do the same, but gcc then
 * does not use the precompiled headers.
 */
#define main TEST_MAIN
