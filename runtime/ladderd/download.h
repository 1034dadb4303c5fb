/* SPDX-License-Identifier: MIT
 *
 * download - programs that come over the link, and the two slots on the disk that hold them.
 *
 * A program is received, verified, written to the older slot, and only then runs. All of it
 * happens in the link thread; the scan thread only exchanges two structs (cycle_swap()).
 */
#ifndef LADDERD_DOWNLOAD_H
#define LADDERD_DOWNLOAD_H

#include "hal/iomap.h"
#include "ladderd/cycle.h"
#include "ladderd/load.h"
#include "ladderd/options.h"
#include "online/server.h"

/* ---- slots ---- */

#define HOST_MOST 64 /* bytes of the name of this machine that become the name of the board */

struct slots {
	const char *folder;    /* of prog.A and prog.B; NULL: no --slots      */
	const char *file, *map; /* of the command line, or NULL               */
	uint8_t *bytes;        /* of the slot that runs; NULL: none           */
	struct slot slot;
	int next;              /* the slot to be written                      */
	bool bad[2];           /* damaged, at the start                       */
	bool empty;            /* no program has been loaded: slots_load()    */
	char lines[HOST_MOST + 16]; /* the map of such a board: its name      */
	uint32_t seq;          /* of the newest one                           */
	uint8_t unlike;        /* the event that says why the next start runs another program
				* than this one; 0: it does not               */
	char why[STATUS_TEXT]; /* its argument                                */
	struct {
		uint8_t unlike;
		char why[STATUS_TEXT];
	} before;              /* the same of the program that ran before     */
	char path[1024];       /* of a slot                                   */
	char old[1024];        /* the name that such a file has had           */
};

/**
 * slots_load - loads the newest good slot; else the files of the command line; else a program
 * that does nothing, so that a desk can bring one
 * @stopped: set for the last of them, as is slots->empty: its identity is 32 zero bytes
 *
 * If a file of the command line has changed since the slot was written, it is newer. Prints
 * what is wrong with a slot. Owns: the caller, slots_close(). Scan-safe: no. Fails: as
 * load_files().
 */
bool slots_load(struct slots *slots, const struct options *options, struct load *load,
		bool *stopped);
void slots_close(struct slots *slots);
/** slots_reject - the slot that runs cannot start: puts it aside, as prog.A.refused. Returns
 * whether the next start finds another program. */
bool slots_reject(struct slots *slots);
/** slots_back - the newest slot had a FAULT on trial: puts it aside. Fails: false: the next
 * start runs it; slots->unlike and slots->why say so. */
bool slots_back(struct slots *slots);
/** slots_store - writes @bytes beside the slot that is to be written, where no start looks.
 * Fails: after a diagnostic in @diags. */
bool slots_store(struct slots *slots, const uint8_t *bytes, size_t len, struct diag_list *diags);
/** slots_keep - what slots_store() wrote becomes the newest slot, also after a power cut. Fails:
 * false: the next start runs the program before; slots->unlike and slots->why say so. */
bool slots_keep(struct slots *slots);
/** slots_drop - forgets what slots_store() wrote. */
void slots_drop(struct slots *slots);
/** slots_beside - SHA-256 of the files of the command line, as they are now. */
void slots_beside(const struct slots *slots, uint8_t out[32]);

/* ---- downloads ---- */

/* A program beside the one that runs. */
struct standby {
	struct arena arena;    /* of all of it but the image                  */
	uint8_t *bytes;        /* image, map and sources, as they came        */
	struct stored stored;
	struct program program;
	struct resource resource;
	struct iomap map;
	uint8_t identity[32];
	const struct carry_plan *plan;
	uint8_t *views;        /* of the link                                 */
	size_t view_size;
	/* While it is on trial: what ran before, as it was then. */
	struct hal lines;      /* of its map; then those of the program before */
	struct channels *channels; /* of its map                             */
	char map_detail[200];
	struct resource before;
	uint8_t before_identity[32];
	char why[160];         /* the FAULT that ended the trial              */
};

struct download;

/** download_new - @map_text: of the map that ladderd began with, borrowed. Owns: the caller,
 * download_free(). Fails: NULL: no memory. */
struct download *download_new(struct slots *slots, struct cycle *cycle, const char *map_text,
			      size_t map_len);
void download_free(struct download *download);
/** download_begin … - as in struct server_store. */
enum refusal download_begin(struct download *download, const uint32_t len[STORED_PARTS],
			    const uint8_t sha[32], uint32_t *received);
enum refusal download_block(struct download *download, uint32_t offset, const uint8_t *bytes,
			    size_t len, uint32_t *received);
enum refusal download_verify(struct download *download, struct standby_view *out, char *detail,
			     size_t size);
enum refusal download_open_lines(struct download *download, char *detail, size_t size);
void download_close_lines(struct download *download);
enum refusal download_store(struct download *download, char *detail, size_t size);
enum refusal download_keep(struct download *download, char *detail, size_t size);
void download_drop(struct download *download);
void download_abort(struct download *download);
/** download_swapped - the standby runs now; returns it. The one before is freed.
 * @comes_back: or kept until download_passed() or download_back() */
struct standby *download_swapped(struct download *download, bool comes_back);
void download_passed(struct download *download);
/** download_back - the program before runs again; @bad: the one that had a FAULT, for
 * standby_free(). Returns NULL for the program that ladderd began with. */
struct standby *download_back(struct download *download, struct standby **bad);
void standby_free(struct standby *standby);
const struct stored *download_running(struct download *download);
/** download_image - the image of the program that runs, or of one of the last before it. Fails:
 * NULL: unknown. */
const uint8_t *download_image(struct download *download, const uint8_t identity[32],
			      uint32_t *len);
#endif
