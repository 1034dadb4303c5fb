/* SPDX-License-Identifier: MIT
 *
 * vm - runs the instructions of a verified program.
 *
 * It relies on the verifier and checks only the budget. It allocates nothing, prints
 * nothing and reads no clock: the time is an argument.
 */
#ifndef SCAN_VM_H
#define SCAN_VM_H

#include "engine/scan/image.h"

enum fault {
	FAULT_NONE,
	FAULT_BUDGET,   /* program loops: watchdog                            */
	FAULT_WATCHDOG, /* scan too late or too long (cycle)                  */
	FAULT_IO,       /* a line did not answer three times (hal)            */
	FAULT_CODE,     /* the image was changed in memory                    */
	FAULT_COUNT,
	FAULT_PAUSED = FAULT_COUNT /* none: the program stands at a safe point */
};
/** fault_text - "instruction budget exceeded"; static. */
const char *fault_text(enum fault fault);

struct vm {
	uint8_t *memory;
	const struct program *program;
	int64_t now_ns;
	uint32_t budget;       /* left for this scan                          */
	uint32_t errors;       /* operations that failed, since the start     */
	uint32_t error_text;   /* word index in CODE_TEXT of the first one    */
	uint32_t fault_text;   /* word index where it stopped                 */
	bool stop;             /* a STOP had power                            */
	uint32_t stop_text;    /* word index of the first one                 */
	/* Safe points, see resource_scan(). */
	volatile int ask;      /* call at_point; a signal handler may set it  */
	uint32_t points;       /* passed since the scan began                 */
	/* @words: up to the next point. True: vm_run() shall end here. */
	bool (*at_point)(struct vm *vm, uint32_t words);
	uint32_t resume;       /* word of the section where vm_run() begins; 0: at the
				* beginning. Where it ended with FAULT_PAUSED. */
	uint32_t until;        /* LUT of the section where vm_run() ends; 0: none. Set before
				* each call; it is 0 afterwards. Not with SMALL=1 */
	uint32_t called;       /* words of CODE_TEXT of all programs that were called; wraps */
#ifndef RUNGBOARD_SMALL
	/* What runs programs; NULL: vm_run(). And what vm_run_counting() calls before it jumps back. */
	enum fault (*run)(struct vm *vm, uint32_t entry, bool watch);
	void (*went_back)(struct vm *vm, const uint32_t *from);
	struct vm_stand *stand; /* of vm_run_stepping(); NULL: it is vm_run_counting() */
#endif
};

/**
 * vm_run - runs one program of the image once
 * @entry: index of the program
 * @watch: run the instrumented section
 *
 * Scan-safe: yes; at most vm->budget instructions, no recursion.
 * Fails: FAULT_BUDGET; the image holds what was written until then. FAULT_PAUSED: at_point()
 * wants it; vm->resume tells where the next call goes on.
 */
enum fault vm_run(struct vm *vm, uint32_t entry, bool watch);
/** vm_run_counting - as vm_run(), and calls vm->went_back() before each jump back, but not before one to
 * an EACH. For the simulation: a board has no use for it, and it would cost vm_run() a part of its speed.
 * Scan-safe, fails: as vm_run(). */
enum fault vm_run_counting(struct vm *vm, uint32_t entry, bool watch);


/* Where vm_run_stepping() may stand, and where it stands. Words count from the begin of the section
 * that is run. */
struct vm_stand {
	const uint8_t *begins; /* by word: not 0: it asks before this instruction */
	/* Shall it stand here? @stand: `word`, `depth` and `back` are set. */
	bool (*asks)(struct vm_stand *stand, struct vm *vm);
	uint32_t word;         /* before which it is asked or stands          */
	uint32_t depth;        /* how many calls it is in                     */
	uint32_t back[LIMIT_CALLS]; /* where each of them goes on             */
	uint32_t run;          /* last target of EACH                         */
	uint32_t starts;       /* how often a program began                   */
	bool stands;           /* set before FAULT_PAUSED; the next call goes on from there */
};
#ifndef RUNGBOARD_SMALL
/** vm_run_stepping - as vm_run_counting(), and can stand before an instruction: FAULT_PAUSED, and
 * `stands` is set. The next call goes on there and asks only before the instructions behind it. For
 * the simulation. Scan-safe: as vm_run(). */
enum fault vm_run_stepping(struct vm *vm, uint32_t entry, bool watch);
#endif

/** vm_look_up - runs @n parts of a LUT, the first one at @part. Scan-safe: yes. */
void vm_look_up(uint8_t *memory, const uint32_t *part, uint32_t n);

/* The arguments of the functions of fn_*.c and blocks of fb_*.c. */
enum fn_status {
	FN_OK,
	FN_WRAPPED,    /* stored, but ENO FALSE and counted                   */
	FN_FAILED,     /* not stored, ENO FALSE, counted                      */
};
struct fn_args {
	enum iec_type type;    /* the type that its FN_IN pins share          */
	enum iec_type result;  /* of out                                      */
	uint32_t count;
	enum iec_type in_type[LIMIT_FN_ARGS]; /* of FN_OWN pins its own     */
	union iec_value in[LIMIT_FN_ARGS];
	union iec_value out;   /* a STRING: any text that lives until the
				  function is called again; it is copied, and
				  cut (ENO FALSE) where there is no room      */
	struct iec_string *room; /* of IEC_STRING_MOST bytes, for such a text */
};
/** vm_function - runs one function of the catalogue, as a scan does. Scan-safe: yes. */
enum fn_status vm_function(enum word word, struct fn_args *args);
#define FN(id, ...) enum fn_status fn_##id(struct fn_args *args);
#include "engine/catalog.def"
#define FB(id, ...) void fb_##id##_step(struct fb_##id *fb, int64_t now_ns);
#include "engine/catalog.def"
#endif
