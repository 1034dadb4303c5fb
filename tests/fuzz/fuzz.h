/* SPDX-License-Identifier: MIT
 *
 * fuzz - what a fuzz target gives: libFuzzer's entry, and its seeds.
 *
 * One target a file, each linked once with libFuzzer and once with replay.c,
 * which needs nothing but a C compiler.
 */
#ifndef FUZZ_FUZZ_H
#define FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>

/** One input, any bytes. Must not crash, leak or hang. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len);

/** fuzz_seed - turns a file of the corpus into an input to mutate; malloc'ed.
 * NULL: use the file as it is. */
uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len);

/** fuzz_expect - stops the program with a message if a promise is broken. */
void fuzz_expect(int promise, const char *text);
#endif
