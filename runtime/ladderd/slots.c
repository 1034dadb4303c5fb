/* SPDX-License-Identifier: MIT
 *
 * slots - prog.A and prog.B: each is replaced as a whole, and verified again at each start. A
 * program is written beside its slot, as prog.A.new, and gets the name of the slot when it runs.
 */
#include "ladderd/download.h"
#include "ladderd/disk.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILE_MOST (64u << 20)
#define FRESH     ".new" /* beside a slot: a program that does not run yet        */

static void add_file(struct digest_sha256 *sha, const char *path)
{
	size_t len = 0;
	char *bytes = path ? file_read(path, FILE_MOST, &len, NULL) : NULL;
	const uint64_t size = bytes ? len : UINT64_MAX;

	digest_sha256_add(sha, &size, sizeof(size));
	if (bytes)
		digest_sha256_add(sha, bytes, len);
	free(bytes);
}

void slots_beside(const struct slots *slots, uint8_t out[32])
{
	struct digest_sha256 sha;

	digest_sha256_init(&sha);
	add_file(&sha, slots->file);
	add_file(&sha, slots->map);
	digest_sha256_end(&sha, out);
}

static bool can_run(const struct stored *stored)
{
	struct program program;
	struct arena scratch;
	enum diag_id why;
	size_t where;
	bool good;

	arena_init(&scratch);
	good = code_open(stored_part(stored, STORED_IMAGE), stored->len[STORED_IMAGE], &scratch,
			 &program, &why, &where);
	arena_free(&scratch);
	return good;
}

/* In slots->path: of prog.A or prog.B, or of a file beside it. NULL: it is too long. */
static const char *path_of(struct slots *slots, int number, const char *beside)
{
	const int len = snprintf(slots->path, sizeof(slots->path), "%s/prog.%c%s", slots->folder,
				 'A' + number, beside);

	return len < (int)sizeof(slots->path) ? slots->path : NULL;
}

static uint8_t *read_slot(struct slots *slots, int number, struct slot *slot, bool *damaged)
{
	const char *path = path_of(slots, number, "");
	size_t len;
	uint8_t *bytes = NULL;

	*damaged = false;
	for (int i = 0; path && !bytes && i < 2; i++) { /* an error may be of the moment */
		errno = 0;
		bytes = (uint8_t *)file_read(path, STORED_MOST + SLOT_HEAD + 4, &len, NULL);
		if (!bytes && errno == ENOENT)
			return NULL;
	}
	if (bytes && slot_open(bytes, len, slot) && can_run(&slot->stored))
		return bytes;
	*damaged = true;
	fprintf(stderr, "ladderd: %s is damaged and is not used\n", path ? path : slots->folder);
	free(bytes);
	return NULL;
}

/* Finds the newest good slot. Returns whether it is to be run. */
static bool find(struct slots *slots, const struct options *options)
{
	const char *folder = options->slots, *file = options->file;
	uint8_t beside[32];

	memset(slots, 0, sizeof(*slots));
	slots->folder = folder;
	if (!folder)
		return false;
	slots->file = file;
	slots->map = options->map;
	for (int i = 0; i < 2; i++)
		if (!options->check && path_of(slots, i, FRESH)) /* of a ladderd that was killed in a download */
			unlink(slots->path);
	for (int i = 0; i < 2; i++) {
		struct slot slot;
		uint8_t *bytes = read_slot(slots, i, &slot, &slots->bad[i]);

		if (!bytes)
			continue;
		if (slots->bytes && slot.seq < slots->slot.seq) {
			free(bytes);
			continue;
		}
		free(slots->bytes);
		slots->bytes = bytes;
		slots->slot = slot;
		slots->seq = slot.seq;
		slots->next = !i;
	}
	if (!slots->bytes)
		return false;
	slots_beside(slots, beside);
	if (file && memcmp(slots->slot.beside, beside, 32) != 0) {
		fprintf(stderr, "ladderd: %s or its map has changed since the last download; it "
			"is used\n", file);
		free(slots->bytes);
		slots->bytes = NULL;
		return false;
	}
	fprintf(stderr, "ladderd: runs the program of download %u%s\n", (unsigned)slots->seq,
		slots->bad[slots->next] ? "; a newer one may be damaged" : "");
	return true;
}

/* A board without program has no map, so it is called as the machine is. */
static void name_board(struct slots *slots)
{
	char host[HOST_MOST + 1] = "";

	if (gethostname(host, HOST_MOST) != 0 || !*host)
		memcpy(host, "board", 6);
	for (char *at = host; *at; at++) /* root may give any bytes */
		if (*at <= ' ' || *at >= 127 || *at == '"' || *at == '\\')
			*at = '-';
	snprintf(slots->lines, sizeof(slots->lines), "BOARD \"%s\"\n", host);
}

bool slots_load(struct slots *slots, const struct options *options, struct load *load,
		bool *stopped)
{
	static const char empty[] = "RUNGBOARD 1\nPROJECT \"none\"\n\nPROGRAM Main LD\nEND_PROGRAM\n";
	const struct stored *stored = &slots->slot.stored;

	if (find(slots, options))
		return load_texts(load, stored_part(stored, STORED_IMAGE),
				  stored->len[STORED_IMAGE],
				  (const char *)stored_part(stored, STORED_MAP),
				  stored->len[STORED_MAP]);
	if (options->file)
		return load_files(load, options->file, options->map,
				  options->link || options->serial);
	fprintf(stderr, "ladderd: no program yet: STOP\n");
	*stopped = slots->empty = true;
	name_board(slots);
	return load_texts(load, empty, sizeof(empty) - 1, slots->lines, strlen(slots->lines));
}

/* One file beside a slot, or the slot itself, gets the name of another, also after a power cut. */
static int change_name(struct slots *slots, int number, const char *from, const char *to)
{
	const char *path = path_of(slots, number, from);
	int error;

	if (!path)
		return -ENAMETOOLONG;
	memcpy(slots->old, path, strlen(path) + 1);
	path = path_of(slots, number, to);
	if (!path)
		return -ENAMETOOLONG;
	if (rename(slots->old, path) != 0 && rename(slots->old, path) != 0) /* a disk may fail once */
		return -errno;
	error = disk_sync_folder(slots->folder);
	if (error)
		fprintf(stderr, "ladderd: %s may not survive a power cut: %s\n", path,
			strerror(-error));
	return 0;
}

/* The newest slot becomes prog.A.refused. */
static int put_aside(struct slots *slots)
{
	return change_name(slots, !slots->next, "", ".refused");
}

/* Fails: false: the event @id tells that the next start runs another program. */
static bool note(struct slots *slots, int error, enum event_id id)
{
	slots->unlike = error ? (uint8_t)id : 0;
	snprintf(slots->why, sizeof(slots->why), "%s", error ? strerror(-error) : "");
	return !error;
}

/* The program before runs again: restores the state and the reason of its slot. */
static void note_before(struct slots *slots)
{
	slots->unlike = slots->before.unlike;
	memcpy(slots->why, slots->before.why, sizeof(slots->why));
}

bool slots_reject(struct slots *slots)
{
	if (!slots->bytes || put_aside(slots) != 0)
		return false;
	fprintf(stderr, "ladderd: the program of download %u cannot start here; the one before "
		"it is used\n", (unsigned)slots->seq);
	return true;
}

bool slots_back(struct slots *slots)
{
	const bool was_kept = slots->unlike != EVENT_NOT_KEPT;

	if (!was_kept) { /* it never was a slot */
		slots_drop(slots);
		note_before(slots);
		return true;
	}
	if (!note(slots, put_aside(slots), EVENT_NOT_BACK))
		return false;
	slots->next = !slots->next;
	note_before(slots);
	return true;
}

bool slots_store(struct slots *slots, const uint8_t *bytes, size_t len, struct diag_list *diags)
{
	const char *path = path_of(slots, slots->next, "");
	struct stat old;

	if (path && stat(path, &old) == 0 && !S_ISREG(old.st_mode)) {
		diag_add(diags, (struct diag){ .id = DIAG_NOT_A_FILE, .file = path }, "%s", "");
		return false;
	}
	path = path_of(slots, slots->next, FRESH);
	return path && file_save(path, bytes, len, diags);
}

bool slots_keep(struct slots *slots)
{
	slots->before.unlike = slots->unlike;
	memcpy(slots->before.why, slots->why, sizeof(slots->why));
	if (!note(slots, change_name(slots, slots->next, FRESH, ""), EVENT_NOT_KEPT))
		return false;
	slots->seq++;
	slots->next = !slots->next;
	return true;
}

void slots_drop(struct slots *slots)
{
	if (path_of(slots, slots->next, FRESH))
		unlink(slots->path);
}

void slots_close(struct slots *slots)
{
	free(slots->bytes);
	slots->bytes = NULL;
}
