/* SPDX-License-Identifier: MIT
 *
 * verify - the parts of the verifier.
 *
 * Private to scan/. code.c checks header, data layout and maps, code_text.c
 * instructions, code_array.c arrays.
 */
#ifndef SCAN_VERIFY_H
#define SCAN_VERIFY_H

#include "engine/scan/code.h"

/* Marks: MARK_TYPE + type at the first byte of a value; read-only ones too. */
enum mark {
	MARK_NONE, MARK_INSIDE, MARK_AREA,
	MARK_TEXT, /* a STRING from its second byte on: equal marks, equal room */
	MARK_VALUE = 32, MARK_FIXED = 64,
};

/* Elements that were checked singly, and are valid. */
struct seen {
	uint32_t first, count, stride;
	bool write;
};
#define VERIFY_SEEN 1024u

struct verifier {
	struct program *program;
	struct arena *scratch;
	uint8_t *mark;         /* one a byte of data memory                 */
	uint32_t data_size, areas;
	uint32_t blocks_left;  /* bytes that BLOCKs may still compare: bounds the time of
			        * verification */
	size_t where;          /* byte offset of the first error            */
	uint32_t walked;       /* elements checked singly                   */
	struct seen *seen;     /* VERIFY_SEEN of them, by hash              */
};

/* Whether a value of @type may be read, or written, at this offset. Scan-safe: yes. */
bool verify_use(const struct verifier *v, uint32_t offset, uint32_t type,
		bool write);
/**
 * verify_elements - whether every element of an array may be read, or written
 * @first:  typed operand of the first one
 * @stride: bytes to the next
 *
 * Scan-safe: yes. Fails: also false when an image asks for more than LIMIT_ELEMENT_WALK
 * steps, all its arrays together.
 */
bool verify_elements(struct verifier *v, uint32_t first, uint32_t count,
		     uint32_t stride, bool write);
/* All combinations of several indices, one after another. */
struct verify_grid {
	const uint32_t *dim;   /* index, low, count, stride each            */
	uint32_t dims, at[LIMIT_INDICES];
	uint64_t offset;       /* of the present element                    */
	bool failed;           /* more steps than an image may use          */
};
/** verify_grid_begin - the first combination. Scan-safe: yes. Fails: false if there is
 * none, or a single stride leads out of data memory. */
bool verify_grid_begin(const struct verifier *v, struct verify_grid *grid, uint32_t base,
		       const uint32_t *dim, uint32_t dims);
/** verify_grid_next - the next one; false: no more, or grid->failed. Scan-safe: yes. */
bool verify_grid_next(struct verifier *v, struct verify_grid *grid);
/** verify_elements_of - verify_elements() with several indices. Scan-safe: yes. */
bool verify_elements_of(struct verifier *v, uint32_t first, const uint32_t *dim,
			uint32_t dims, bool write);
/** verify_bits - the same for @count packed bits of an area; @first is counted from the
 * first area. Scan-safe: yes. */
bool verify_bits(const struct verifier *v, uint32_t first, uint64_t count,
		 bool write);
/** verify_all - whether @n values of a type, one after another, may be read, or written.
 * Scan-safe: yes. */
bool verify_all(const struct verifier *v, uint32_t first, uint32_t n, enum iec_type type,
		bool write);
/** verify_tick - the operands of TICK. Scan-safe: yes. */
bool verify_tick(const struct verifier *v, const uint32_t *at, uint32_t n);
/** verify_refuse - records the place of the first error; returns false. */
bool verify_refuse(struct verifier *v, const void *at);
/** verify_runs_before - how many runs begin at @offset or before it. Scan-safe: yes. */
uint32_t verify_runs_before(const struct program *program, uint32_t offset);
/** verify_programs - checks the instructions of all programs. */
bool verify_programs(struct verifier *v);
/** verify_tasks - checks tasks and the programs they run. */
bool verify_tasks(struct verifier *v);

static inline bool verify_is_type(uint32_t type)
{
	return type > IEC_NONE && type < IEC_TYPE_COUNT;
}
#endif
