/* SPDX-License-Identifier: MIT
 *
 * code_access - the memory that the instructions of a program read and write.
 *
 * For checks outside a scan: which inputs and outputs a program uses.
 */
#ifndef SCAN_CODE_ACCESS_H
#define SCAN_CODE_ACCESS_H

#include "engine/scan/code.h"

struct code_access {
	uint64_t bit, bits;  /* of memory: the first, how many. A BOOL outside of the
				areas is a byte, so 8                         */
	uint32_t unit;       /* bits of one element; else as `bits`           */
	bool write;
};

/**
 * code_each_access - steps through the accesses of CODE_TEXT, in order
 * @program: verified
 *
 * A call of a block of the catalogue is a read and a write of its whole instance. An
 * element with a computed index is an access to all elements that the index can select.
 * Scan-safe: no.
 */
void code_each_access(const struct program *program,
		      void (*take)(void *context, const struct code_access *access),
		      void *context);
/** code_has_pointers - does it reach memory that no instruction names? Scan-safe: yes. */
#ifndef RUNGBOARD_SMALL
bool code_has_pointers(const struct program *program);
#else
static inline bool code_has_pointers(const struct program *program)
{
	(void)program;
	return false; /* it has no such instructions */
}
#endif
/** code_access - the accesses of one instruction of a verified program. As code_each_access(),
 * without a program: of a STRING only its head is given. Scan-safe: no. */
void code_access(const uint32_t *code,
		 void (*take)(void *context, const struct code_access *access),
		 void *context);
#endif
