/* SPDX-License-Identifier: MIT
 *
 * sums - sums of the blocks of a program, by which a desk finds what a board has already.
 *
 * The weak sum of a window can be moved by a byte without reading the window again; the
 * strong one says that two blocks are very likely the same. The SHA-256 of the
 * whole decides whether a program is right.
 */
#ifndef ONLINE_SUMS_H
#define ONLINE_SUMS_H

#include <stdint.h>

#define SUMS_LEAST  64u        /* bytes of a block                              */
#define SUMS_MOST   32768u
#define SUMS_STRONG 8u         /* bytes of a strong sum                         */
#define SUMS_BYTES  (4u + SUMS_STRONG) /* of both                               */
#define SUMS_PAGE   4096u      /* blocks of one answer, at most                 */
#define SUMS_WORK   (1u << 20) /* bytes whose sums are in one answer, at most   */

/* Pieces of a program, service `pieces`. */
enum piece { PIECE_COPY, PIECE_BYTES };

/** sums_weak - low 16 bits: the sum of the bytes; high 16: the sum of all sums on the way.
 * Scan-safe: yes; so are all functions. */
uint32_t sums_weak(const uint8_t *bytes, uint32_t len);
/** sums_roll - the window of @len bytes moves by one: @gone leaves it, @come is new. */
uint32_t sums_roll(uint32_t weak, uint32_t len, uint8_t gone, uint8_t come);
/** sums_strong - the first bytes of the SHA-256. */
void sums_strong(const uint8_t *bytes, uint32_t len, uint8_t out[SUMS_STRONG]);
#endif
