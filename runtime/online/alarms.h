/* SPDX-License-Identifier: MIT
 *
 * alarms - the list of alarms of a board: what came, went and was acknowledged, when and by whom.
 *
 * The scan thread looks at the blocks ALARM, ALARM_LIMIT and EVENT after each scan, and puts what
 * changed into a ring; the thread that owns the list takes it out. The ring may be full: then the
 * change is looked at again after the next scan. The list has ALARM_ROWS rows. The oldest finished
 * row makes room for a new one, never one that is active or waits for an acknowledgement; alarms without
 * room are counted. An alarm that comes again within a minute goes on with its row. Texts come from
 * programs: replace characters that are not printable before they are shown. It opens no file and reads no clock.
 */
#ifndef ONLINE_ALARMS_H
#define ONLINE_ALARMS_H

#include "engine/scan/resource.h"
#include "online/wire.h"

#include <stdatomic.h>

#define ALARM_ROWS  256u      /* of a list                                    */
#define ALARM_MOST  4096u     /* blocks of a program that are watched          */
#define ALARM_RING  64u
#define ALARM_BYTES 320u      /* of a sealed row                              */

/* The board's own alarms, class 0. */
enum alarm_system {
#define ALARM(id, name, quiet, text) ALARM_##id,
#include "online/alarms.def"
	ALARM_SYSTEMS
};

enum alarm_state { /* of IEC 62682, and one for events                      */
	ALARM_NORMAL, ALARM_UNACK, ALARM_ACKED, ALARM_GONE_UNACK, ALARM_EVENT,
};

struct alarm_row {
	uint32_t number;       /* from 1 on; 0: the row is free                */
	uint32_t times;        /* how often it came                           */
	uint8_t state;         /* enum alarm_state                            */
	uint8_t class;         /* 0 system, 1 error, 2 warning, 3 notice       */
	int64_t came_ns, went_ns, acked_ns; /* since 1970; 0: not yet         */
	char name[64];         /* of the block, or SYS_…                       */
	char text[WORD_TEXT + 1];
	char who[32];          /* acknowledged it; "": the program             */
};

enum alarm_kind { ALARM_OF_CONDITION, ALARM_OF_LIMIT, ALARM_OF_EVENT };

/* A block that is watched, at its place in the memory of the program. */
struct alarm_block {
	uint32_t at;           /* offset of the instance                      */
	uint32_t kind;         /* enum alarm_kind                             */
	uint32_t count;        /* that the list got last                       */
	uint8_t state;
	char name[64];
};
struct alarm_watch {
	const struct program *program;
	uint32_t count, left_out; /* blocks; those beyond ALARM_MOST           */
	struct alarm_block block[];
};

/* What the scan thread tells. */
struct alarm_note {
	uint8_t state, class;
	uint8_t system;        /* 1 + enum alarm_system; 0: of a block         */
	uint8_t sync;          /* all blocks were looked at since the watch began */
	uint32_t times;        /* it came so often since the last note         */
	int64_t time_ns;       /* of the scan; the list wants it since 1970   */
	char name[64], text[WORD_TEXT + 1];
};
struct alarm_ring {
	_Atomic(struct alarm_watch *) watch;  /* NULL: nothing is watched      */
	_Atomic uint32_t put, taken;
	struct alarm_watch *seen;             /* scan thread: looked at before */
	bool synced;
	uint8_t systems;                      /* a bit for each that is active */
	struct alarm_note note[ALARM_RING];
};

struct alarm_list {
	uint32_t last;         /* number of the newest row                    */
	uint32_t lost;         /* how often one came and found no room         */
	bool changed;          /* some row is dirty                            */
	bool dirty[ALARM_ROWS], unsure[ALARM_ROWS];
	struct alarm_row row[ALARM_ROWS];
};

/* All of a board. The scan thread uses `ring`, the thread of the link the rest. */
struct alarms {
	struct alarm_ring ring;
	struct alarm_list list;
	struct alarm_watch *watch, *before; /* owned; `before` may still be looked at */
	int64_t (*clock_ns)(void);          /* since 1970                      */
};

/** alarm_watch_new - the blocks of the program of @image, whose memory is not read. Owns: the caller, free(). Scan-safe: no. Fails: NULL:
 * no memory. A program without names has none. */
struct alarm_watch *alarm_watch_new(const struct image *image);
/** alarm_watch_carry - @to goes on where blocks of the same name and kind were: what a
 * block counted before a download does not come again, and its text is read again. Only when no scan
 * looks at either. */
void alarm_watch_carry(struct alarm_watch *to, const struct alarm_watch *from);
/** alarm_begin - the program has started, its retained values are there: how often a block came
 * before does not count again; its state is read after the first scan. Scan-safe: yes. */
void alarm_begin(struct alarm_ring *ring, const struct resource *resource);
/** alarm_look - after a scan: puts changes into the ring. Scan-safe: yes; bounded by the blocks. */
void alarm_look(struct alarm_ring *ring, const struct resource *resource);
/** alarm_take - the next note. The thread of the list. Fails: false: there is none. */
bool alarm_take(struct alarm_ring *ring, struct alarm_note *out);

/** alarm_list_doubt - another program runs, or the board has begun (@begins): alarms that are not
 * reported again until all notes up to the one with `sync` were taken. */
void alarm_list_doubt(struct alarm_list *list, bool begins);
/** alarm_list_note - brings the list up to date. */
void alarm_list_note(struct alarm_list *list, const struct alarm_note *note);
/** alarm_list_raise - one of the board's own. Nothing happens if it is as it was. */
void alarm_list_raise(struct alarm_list *list, enum alarm_system system, bool active, int64_t time_ns);
/** alarm_list_find - a row by its number; NULL: none. */
struct alarm_row *alarm_list_find(struct alarm_list *list, uint32_t number);
/** alarm_list_next - the row with the least number from @number on; NULL: none. */
const struct alarm_row *alarm_list_next(const struct alarm_list *list, uint32_t number);
/** alarm_waits - whether a row waits for an acknowledgement. */
bool alarm_waits(const struct alarm_row *row);
/** alarm_list_ack - @who has acknowledged a row; one that does not wait is left as it is. */
void alarm_list_ack(struct alarm_list *list, uint32_t number, const char *who, int64_t time_ns);
/** alarm_list_count - rows that are active, and that wait for an acknowledgement. */
void alarm_list_count(const struct alarm_list *list, uint32_t *active, uint32_t *waiting);
/** alarm_block_find - the block of this name; NULL: the program has none. */
const struct alarm_block *alarm_block_find(const struct alarm_watch *watch, const char *name);
/** alarm_block_ack - the place of its OP_ACK; type IEC_NONE: it has none. */
struct location alarm_block_ack(const struct alarm_block *block);

/** alarm_put, alarm_read - the fields of a row. Fails: the reader has failed. */
void alarm_put(struct wire_writer *out, const struct alarm_row *row);
void alarm_read(struct wire_reader *in, struct alarm_row *row);
/** alarm_seal, alarm_open - a row with its version and checksum in ALARM_BYTES. Fails: false: no row,
 * or damaged; *empty: there was never one. */
void alarm_seal(const struct alarm_row *row, uint32_t version, uint8_t *out);
bool alarm_open(const uint8_t *bytes, struct alarm_row *row, uint32_t *version, bool *empty);
/** alarm_state_word - "active", "acknowledged" …; alarm_class_word - "system", "error" … Static. */
const char *alarm_state_word(uint8_t state);
const char *alarm_class_word(uint8_t class);
#endif
