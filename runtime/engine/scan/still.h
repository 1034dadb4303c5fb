/* SPDX-License-Identifier: MIT
 *
 * still - leaves out the parts of a program whose result cannot have changed.
 *
 * A program is cut into stretches. A stretch touches the places that it reads or writes. If no
 * byte of them has changed since it ran last, and it changed none of them itself then, it would
 * do again what it has done: it is left out. Everything comes from the verified instructions,
 * nothing from the file, so no file can say something wrong about it.
 *
 * A board with SMALL=1 is built without it.
 */
#ifndef SCAN_STILL_H
#define SCAN_STILL_H

#include "engine/scan/code_access.h"
#include "engine/scan/vm.h"

#define STILL_BLOCK 64u  /* bytes of data memory that are compared together  */
#define STILL_LEAST 256u /* words of a stretch, as a rule: 64 contacts or so  */
#define STILL_NONE UINT32_MAX

/* From one place of CODE_TEXT, which control reaches from nowhere else, to another. It may begin
 * and end between two parts of a LUT. */
struct stretch {
	uint32_t begin, end;      /* words; @end is that of the next one       */
	uint32_t head, head_parts; /* the rest of a LUT: word of its first part */
	uint32_t from, stop;      /* then instructions, up to the LUT at @stop, 0: to the end of
				   * the program. @from STILL_NONE: none      */
	uint32_t tail_parts;      /* then the first parts of the LUT at @stop  */
	uint32_t written, written_count; /* of still->written                  */
	bool always;              /* its result depends on the time            */
	bool pays;                /* it may take from the budget, or call      */
};

/* The stretches of one program, and what they took from the budget in their last runs. */
struct still_program {
	uint32_t first, count;
	uint64_t spent, called;
};

enum still_why { STILL_GOOD, STILL_INTERRUPTED, STILL_LARGE, STILL_TIMED, STILL_POINTERS,
		 STILL_NO_MEMORY };

struct still {
	/* Computed once. */
	const struct program *program;
	struct still_program *part;  /* of each entry of the program           */
	struct stretch *stretch;
	uint32_t count, words;       /* stretches; words of 64 bits for them   */
	uint32_t blocks;             /* of data memory, the last may be shorter */
	uint32_t rest;               /* its bytes; 0: it is whole              */
	uint64_t *mask;              /* of each block: the bytes that are touched */
	uint64_t *touched_by;        /* of each block: a bit for each stretch  */
	uint32_t *written;           /* blocks that stretches write            */
	uint64_t *always;
	uint32_t *outside;           /* blocks of inputs and system words      */
	uint64_t *unpacked;          /* bytes of them that have bits with bytes of their own */
	uint32_t *row_end;           /* … behind the last of those in a row    */
	uint32_t outside_count;
	uint8_t *walked;             /* for still_each()                       */
	bool in_order;               /* so are the bytes of bits               */
	/* The state. */
	uint8_t *seen;               /* data memory as it was compared last    */
	uint64_t *pending;           /* stretches that must run                */
	uint64_t *changed;           /* blocks of this scan                    */
	uint32_t *spent, *called;    /* of each stretch that pays, in its last run */
	bool any_changed;
	bool on;                     /* in this scan                           */
	bool stale;                  /* a scan ran without it                  */
	bool later;                  /* than the scan before                   */
	int64_t now_ns;
	uint32_t wait, pause, calm;  /* scans that run as a whole, see still.c */
	uint64_t ran, all;           /* stretches, since still_new(): that ran, or were left out */
};

/**
 * still_new - cuts a program into stretches
 * @least:   words of a stretch, if no more than that are between two cuts; STILL_LEAST
 * @keep:    holds the result, while it is used
 * @why:     gets the reason of a failure; or NULL
 *
 * Owns: @keep. Scan-safe: no.
 * Fails: NULL: then every scan runs the whole program.
 */
struct still *still_new(const struct program *program, uint32_t least, struct arena *keep,
			enum still_why *why);
/** still_each - the accesses of a stretch, also those of what it calls. Scan-safe: no. */
void still_each(const struct still *still, uint32_t stretch,
		void (*take)(void *context, const struct code_access *access), void *context);
/** still_carries - of each byte of data memory, whether its value can matter to a later scan, or to
 * somebody outside; 0: it is a temporary. Owns: @arena. Scan-safe: no. Fails: NULL: not known. */
uint8_t *still_carries(const struct program *program, struct arena *arena);
/** still_why_text - why there are no stretches; static. */
const char *still_why_text(enum still_why why);

/** still_reset - the state of the program has been replaced: everything runs in the next scan.
 * @still may be NULL. Scan-safe: yes. */
void still_reset(struct still *still);
struct image;
/**
 * still_begin - what image_begin() does, as far as something has changed
 * @may: false: this scan must run the whole program
 *
 * Scan-safe: yes. False: it has done nothing, and the whole program must run.
 */
bool still_begin(struct still *still, struct image *image, int64_t now_ns, bool may);
/** still_run - vm_run() of one program, without the stretches that would change nothing. Between
 * still_begin() and still_end(). Scan-safe: yes. Fails: as vm_run(). */
enum fault still_run(struct still *still, struct vm *vm, uint32_t entry);
/** still_end - what image_end() does, likewise. False: it has done nothing. */
bool still_end(struct still *still, struct image *image);
#endif
