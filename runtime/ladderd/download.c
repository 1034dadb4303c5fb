/* SPDX-License-Identifier: MIT
 *
 * download - receives, verifies, stores.
 */
#include "ladderd/download.h"
#include "ladderd/control.h"
#include "ladderd/guarded.h"
#include "ladderd/link.h"

#include "hal/channels.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"
#include "engine/scan/carry.h"
#include "engine/scan/still.h"
#include "engine/scan/symbol_index.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PAST 4 /* programs that ran before, for the record                       */

/* The image of a program that ran. */
struct past {
	uint8_t identity[32];
	uint8_t *image;                /* NULL: none                           */
	uint32_t len;
};

struct download {
	struct slots *slots;
	struct cycle *cycle;
	const char *map_text;          /* of the lines that are open           */
	size_t map_len;
	struct stored first;           /* the program that ladderd began with  */
	uint8_t *first_bytes;
	uint8_t first_identity[32];
	struct past past[PAST];        /* the newest one first                 */
	struct standby *runs;          /* NULL: the first program              */
	struct standby *before;        /* the one before, during a trial       */
	bool trial;
	struct standby *standby;       /* NULL: none was verified              */
	/* Being received. */
	uint8_t *bytes;
	struct stored wanted;
	uint8_t sha[32];
	uint32_t received;
};

/* ---- standby ---- */

/* The lines that went with the program before, or that never came. */
static void release(struct standby *standby)
{
	hal_close_rest(&standby->lines);
	standby->lines.request_count = 0;
}

void standby_free(struct standby *standby)
{
	if (!standby)
		return;
	release(standby);
	arena_free(&standby->arena);
	free(standby->bytes);
	free(standby->views);
	free(standby);
}

/* The parts of a diagnostic: its code and text. */
static void say_diag(const struct diag *diag, char *detail, size_t size)
{
	char text[600];
	size_t len;

	diag_print(diag, text, sizeof(text));
	len = strlen(text);
	if (len >= size)
		len = size - 1;
	memcpy(detail, text, len);
	detail[len] = '\0';
}

static bool open_image(struct standby *standby, char *detail, size_t size)
{
	struct diag diag = { .file = "program" };
	struct arena scratch;
	size_t where = 0;
	uint8_t *image = arena_alloc(&standby->arena, standby->stored.len[STORED_IMAGE] + 8u);
	bool good = false;

	if (!image)
		return false;
	memcpy(image, stored_part(&standby->stored, STORED_IMAGE),
	       standby->stored.len[STORED_IMAGE]);
	arena_init(&scratch);
	good = code_open(image, standby->stored.len[STORED_IMAGE], &scratch, &standby->program,
			 &diag.id, &where);
	arena_free(&scratch);
	if (!good) {
		snprintf(diag.arg, sizeof(diag.arg), "byte %zu", where);
		say_diag(&diag, detail, size);
	}
	return good;
}

static bool open_map(struct standby *standby, char *detail, size_t size)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good;

	if (!diags)
		return false;
	diag_init(diags);
	good = iomap_read(&standby->map, &standby->arena, "map",
			  (const char *)stored_part(&standby->stored, STORED_MAP),
			  standby->stored.len[STORED_MAP], diags) &&
	       iomap_check_program(&standby->map, &standby->program, &standby->arena, diags);
	for (int i = 0; i < diags->count && !good; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR) {
			say_diag(&diags->diag[i], detail, size);
			break;
		}
	free(diags);
	return good;
}

static bool make_ready(struct download *download, struct standby *standby)
{
	void *memory = arena_alloc(&standby->arena, image_memory_size(&standby->program));

	if (!memory)
		return false;
	standby->view_size = image_memory_size(&standby->program);
	standby->views = calloc(3, standby->view_size);
	standby->program.index = symbol_index_new(&standby->program, &standby->arena);
	resource_init(&standby->resource, &standby->program, memory);
	if (HAS_STILL && !download->cycle->full_scan)
		standby->resource.still = still_new(&standby->program, STILL_LEAST,
						    &standby->arena, NULL);
	code_identity(&standby->program, standby->identity);
	standby->plan = carry_plan_new(&standby->program,
				       download->cycle->resource.image.program,
				       &standby->arena);
	return standby->views && standby->plan;
}

/* ---- as in struct server_store ---- */

enum refusal download_begin(struct download *download, const uint32_t len[STORED_PARTS],
			    const uint8_t sha[32], uint32_t *received)
{
	struct stored wanted = { .bytes = NULL };
	uint8_t *bytes;

	memcpy(wanted.len, len, sizeof(wanted.len));
	if (download->bytes && memcmp(download->sha, sha, 32) == 0 &&
	    memcmp(download->wanted.len, len, sizeof(wanted.len)) == 0) {
		*received = download->received; /* goes on where it was cut */
		return REFUSAL_NONE;
	}
	if (!download->slots->folder)
		return REFUSAL_NO_STORE;
	bytes = malloc(stored_size(&wanted));
	if (!bytes)
		return REFUSAL_MEMORY;
	download_abort(download);
	download->bytes = bytes;
	download->wanted = wanted;
	memcpy(download->sha, sha, 32);
	*received = 0;
	return REFUSAL_NONE;
}

enum refusal download_block(struct download *download, uint32_t offset, const uint8_t *bytes,
			    size_t len, uint32_t *received)
{
	const uint32_t size = stored_size(&download->wanted);

	if (!download->bytes)
		return REFUSAL_NO_DOWNLOAD;
	*received = download->received;
	if (offset < download->received)
		return REFUSAL_NONE; /* it came twice */
	if (offset > download->received || len > size - offset)
		return REFUSAL_NOT_WHOLE;
	standby_free(download->standby);
	download->standby = NULL;
	memcpy(download->bytes + offset, bytes, len);
	*received = download->received += (uint32_t)len;
	return REFUSAL_NONE;
}

static bool is_whole(const struct download *download)
{
	const uint32_t size = stored_size(&download->wanted);
	struct digest_sha256 sha;
	uint8_t found[32];

	if (!download->bytes || download->received != size)
		return false;
	digest_sha256_init(&sha);
	digest_sha256_add(&sha, download->bytes, size);
	digest_sha256_end(&sha, found);
	return memcmp(found, download->sha, 32) == 0;
}

/* Prepares the lines of the new map, and says whether they can be exchanged. */
static bool open_beside(struct download *download, struct standby *standby,
			struct standby_view *out)
{
	const struct stored *runs = download_running(download);
	struct diag_list *diags = calloc(1, sizeof(*diags));
	enum hal_beside result;
	char line[LIMIT_ARG];

	if (!diags)
		return false;
	diag_init(diags);
	standby->map.dev = download->cycle->hal.map->dev;
	result = hal_beside(&standby->lines, &download->cycle->hal, &standby->map,
			    &standby->arena, diags, line);
	standby->channels = hal_channels(&standby->lines);
	out->map = result != BESIDE_GOOD ? MAP_RESTART : MAP_EXCHANGED;
	if (result == BESIDE_GOOD && standby->stored.len[STORED_MAP] == runs->len[STORED_MAP] &&
	    memcmp(stored_part(&standby->stored, STORED_MAP), stored_part(runs, STORED_MAP),
		   runs->len[STORED_MAP]) == 0)
		out->map = MAP_SAME;
	out->map_refusal = result == BESIDE_GOOD ? REFUSAL_NONE :
			   result == BESIDE_RESTART ? REFUSAL_MAP_CHANGED : REFUSAL_INVALID;
	out->map_detail = standby->map_detail;
	if (result == BESIDE_RESTART)
		snprintf(standby->map_detail, sizeof(standby->map_detail), "%s", line);
	if (result == BESIDE_REFUSED && diags->count)
		say_diag(&diags->diag[0], standby->map_detail, sizeof(standby->map_detail));
	free(diags);
	return true;
}

enum refusal download_verify(struct download *download, struct standby_view *out, char *detail,
			     size_t size)
{
	struct standby *standby;

	if (!download->bytes)
		return REFUSAL_NO_DOWNLOAD;
	if (download->trial) {
		snprintf(detail, size, "a program is on trial");
		return REFUSAL_BUSY;
	}
	if (!is_whole(download)) {
		if (download->received == stored_size(&download->wanted))
			download_abort(download); /* a byte is wrong, nobody knows which */
		return REFUSAL_NOT_WHOLE;
	}
	standby_free(download->standby);
	download->standby = NULL;
	standby = calloc(1, sizeof(*standby));
	if (!standby)
		return REFUSAL_MEMORY;
	arena_init(&standby->arena);
	standby->stored = download->wanted;
	standby->stored.bytes = download->bytes;
	detail[0] = '\0';
	if (!open_image(standby, detail, size) || !open_map(standby, detail, size)) {
		standby_free(standby);
		return *detail ? REFUSAL_INVALID : REFUSAL_MEMORY;
	}
	if (!make_ready(download, standby) || !open_beside(download, standby, out)) {
		standby_free(standby);
		return REFUSAL_MEMORY;
	}
	download->standby = standby;
	out->standby = standby;
	out->plan = standby->plan;
	memcpy(out->identity, standby->identity, 32);
	return REFUSAL_NONE;
}

enum refusal download_open_lines(struct download *download, char *detail, size_t size)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good;

	if (!diags)
		return REFUSAL_MEMORY;
	diag_init(diags);
	guarded_more(&download->standby->lines);
	good = hal_open_new(&download->standby->lines, diags);
	if (!good)
		guarded_more(NULL);
	if (!good && diags->count)
		say_diag(&diags->diag[0], detail, size);
	free(diags);
	return good ? REFUSAL_NONE : REFUSAL_INVALID;
}

void download_close_lines(struct download *download)
{
	if (download->standby)
		hal_close_rest(&download->standby->lines);
	guarded_more(NULL);
}

enum refusal download_store(struct download *download, char *detail, size_t size)
{
	struct slots *slots = download->slots;
	const size_t len = SLOT_HEAD + stored_size(&download->wanted) + 4u;
	struct diag_list *diags = calloc(1, sizeof(*diags));
	uint8_t *bytes = malloc(len);
	struct stored stored = download->wanted;
	uint8_t beside[32];
	bool good = false;

	stored.bytes = download->bytes;
	if (diags && bytes) {
		diag_init(diags);
		slots_beside(slots, beside);
		slot_seal(&stored, slots->seq + 1, beside, bytes);
		good = slots_store(slots, bytes, len, diags);
		if (diags->count)
			say_diag(&diags->diag[0], detail, size);
	}
	free(bytes);
	free(diags);
	return good ? REFUSAL_NONE : REFUSAL_DISK;
}

enum refusal download_keep(struct download *download, char *detail, size_t size)
{
	if (slots_keep(download->slots))
		return REFUSAL_NONE;
	snprintf(detail, size, "%s", download->slots->why);
	return REFUSAL_DISK;
}

void download_drop(struct download *download)
{
	slots_drop(download->slots);
}

void download_abort(struct download *download)
{
	standby_free(download->standby);
	download->standby = NULL;
	free(download->bytes);
	download->bytes = NULL;
	download->received = 0;
}

static const uint8_t *running_identity(const struct download *download)
{
	return download->runs ? download->runs->identity : download->first_identity;
}

/* The record may hold scans of the program that goes. */
static void keep_image(struct download *download)
{
	const struct stored *stored = download_running(download);
	const uint32_t len = stored->len[STORED_IMAGE];
	struct past past;

	for (int i = 0; i < PAST; i++)
		if (download->past[i].image &&
		    memcmp(download->past[i].identity, running_identity(download), 32) == 0)
			return; /* it ran before, too */
	past = (struct past){ .image = len ? malloc(len) : NULL, .len = len };
	if (!past.image)
		return;
	memcpy(past.image, stored_part(stored, STORED_IMAGE), len);
	memcpy(past.identity, running_identity(download), sizeof(past.identity));
	free(download->past[PAST - 1].image);
	memmove(&download->past[1], &download->past[0], (PAST - 1) * sizeof(past));
	download->past[0] = past;
}

const uint8_t *download_image(struct download *download, const uint8_t identity[32],
			      uint32_t *len)
{
	const struct stored *stored = download_running(download);

	if (memcmp(running_identity(download), identity, 32) == 0) {
		*len = stored->len[STORED_IMAGE];
		return *len ? stored_part(stored, STORED_IMAGE) : NULL;
	}
	for (int i = 0; i < PAST; i++) {
		const struct past *past = &download->past[i];

		*len = past->len;
		if (past->image && memcmp(past->identity, identity, 32) == 0)
			return past->image;
	}
	return NULL;
}

struct standby *download_swapped(struct download *download, bool comes_back)
{
	struct standby *standby = download->standby;

	keep_image(download);
	if (comes_back) {
		download->before = download->runs;
	} else {
		release(standby);
		standby_free(download->runs);
	}
	download->trial = comes_back;
	download->runs = standby;
	download->standby = NULL;
	standby->bytes = download->bytes;
	download->bytes = NULL;
	download->received = 0;
	return standby;
}

void download_passed(struct download *download)
{
	release(download->runs);
	standby_free(download->before);
	download->before = NULL;
	download->trial = false;
}

struct standby *download_back(struct download *download, struct standby **bad)
{
	keep_image(download);
	*bad = download->runs;
	standby_free(download->standby); /* its plan is beside the bad one */
	download->standby = NULL;
	download->runs = download->before;
	download->before = NULL;
	download->trial = false;
	return download->runs;
}

const struct stored *download_running(struct download *download)
{
	return download->runs ? &download->runs->stored : &download->first;
}

/* ---- the scan thread ---- */

/* Goes on with the lines of another map. The name of the board is that of the map, unless
 * somebody gave it one. The link thread, which may read the name meanwhile, frees the map. */
static void take_lines(struct cycle *cycle, struct hal *lines)
{
	const bool of_map = cycle_board(cycle) == cycle->hal.map->board;

	hal_exchange(&cycle->hal, lines);
	guarded_lines(&cycle->hal);
	if (of_map)
		cycle_name(cycle, "", cycle->hal.map->board);
}

/* Goes on with another resource. */
static void take(struct cycle *cycle, const struct resource *resource, const uint8_t identity[32])
{
	cycle->resource = *resource;
	if (HAS_STILL)
		still_reset(cycle->resource.still);
	cycle->store = NULL;
	memcpy(cycle->identity_bytes, identity, sizeof(cycle->identity_bytes));
	event_program(identity, cycle->identity);
	monitor_limit(cycle_plan(cycle, cycle->wanted_ns, cycle->watchdog));
	cycle->failed = cycle->resource.vm.errors != 0;
	link_note(cycle->link, NOTE_SWAP, 0);
}

enum refusal cycle_swap(struct cycle *cycle, struct standby *standby, uint32_t back)
{
	if (!carry_apply(standby->plan, &standby->resource, &cycle->resource))
		return REFUSAL_CONFLICT;
	standby->before = cycle->resource;
	memcpy(standby->before_identity, cycle->identity_bytes, sizeof(cycle->identity_bytes));
	take(cycle, &standby->resource, standby->identity);
	take_lines(cycle, &standby->lines);
	cycle->trial = back ? standby : NULL;
	cycle->trial_left = back;
	control_tell("another program runs, put there by a desk");
	return REFUSAL_NONE;
}

/* Its memory is as it was: nothing of what the new program did remains. Time and the number
 * of scans go on. If the scan was too long, the outputs have their safe values by now. */
void cycle_back(struct cycle *cycle, enum fault fault)
{
	struct standby *bad = cycle->trial;
	struct resource *before = &bad->before;

	resource_fail(&cycle->resource, fault);
	link_note(cycle->link, NOTE_FAULT, 0);
	control_print_fault(&cycle->resource, bad->why, sizeof(bad->why));
	before->scans = cycle->resource.scans;
	before->scan_us = cycle->resource.scan_us;
	before->watch = false;
	tasks_skip(&before->tasks, before->image.program, cycle->resource.vm.now_ns);
	take(cycle, before, bad->before_identity);
	take_lines(cycle, &bad->lines);
	cycle->trial = NULL;
	cycle->late_row = 0;
	cycle->monitor.tripped = 0;
	hal_release(&cycle->hal);
	control_tell("FAULT in the new program; the one before goes on");
	link_trial_over(cycle->link, true);
}

void cycle_pass(struct cycle *cycle)
{
	if (!cycle->trial)
		return;
	cycle->trial = NULL;
	link_trial_over(cycle->link, false);
}

/* ---- all of it ---- */

/* The program that ladderd began with: its slot, or its image and map without sources; of an empty
 * board nothing. */
static bool take_first(struct download *download)
{
	const struct program *program = download->cycle->resource.image.program;
	struct stored *first = &download->first;

	if (download->slots->bytes) {
		*first = download->slots->slot.stored;
		return true;
	}
	if (!download->slots->empty) {
		first->len[STORED_IMAGE] = program->header->size;
		first->len[STORED_MAP] = (uint32_t)download->map_len;
		if (!stored_size(first))
			return false;
	}
	download->first_bytes = malloc(stored_size(first) + 1);
	if (!download->first_bytes)
		return false;
	memcpy(download->first_bytes, program->base, first->len[STORED_IMAGE]);
	memcpy(download->first_bytes + first->len[STORED_IMAGE], download->map_text,
	       first->len[STORED_MAP]);
	first->bytes = download->first_bytes;
	return true;
}

struct download *download_new(struct slots *slots, struct cycle *cycle, const char *map_text,
			      size_t map_len)
{
	struct download *download = calloc(1, sizeof(*download));

	if (!download)
		return NULL;
	download->slots = slots;
	download->cycle = cycle;
	download->map_text = map_text;
	download->map_len = map_len;
	memcpy(download->first_identity, cycle->identity_bytes, sizeof(download->first_identity));
	if (take_first(download))
		return download;
	download_free(download);
	return NULL;
}

void download_free(struct download *download)
{
	if (!download)
		return;
	download_abort(download);
	standby_free(download->runs); /* the lines of the one before go with it */
	standby_free(download->before);
	for (int i = 0; i < PAST; i++)
		free(download->past[i].image);
	free(download->first_bytes);
	free(download);
}
