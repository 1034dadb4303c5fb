/* SPDX-License-Identifier: MIT
 *
 * disks - what a board stores, on a disk that fails.
 *
 * Each scenario runs on files that are good. Its k-th call of open, mkstemp, read, pread, write,
 * pwrite, fsync, fdatasync, ftruncate or rename fails, for all k: once, three times or from then
 * on, as a disk that is broken or full, with a write that takes half, or with a signal. Then the disk is well
 * again and everything is loaded as at a start: what was told to be stored is there, nothing
 * else has gone, and what is not stored was told. Then each file is cut at every byte and
 * loses random bits.
 */
#define _GNU_SOURCE /* open_memstream(), mkdtemp(), O_TMPFILE */
#include "ladderd/alarm_store.h"
#include "ladderd/conf.h"
#include "ladderd/download.h"
#include "ladderd/ends.h"
#include "ladderd/journal.h"
#include "ladderd/password.h"
#include "ladderd/store_file.h"
#include "tests/unit/rig.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)
#define CALLS_MOST 2000

/* ---- the disk ---- */

enum kind { BROKEN, FULL, HALF, SIGNAL, KINDS };
static const char *const kind_name[KINDS] = { "EIO", "ENOSPC", "half", "EINTR" };
static int calls, fail_at; /* counted from 1; 0: never                       */
static int times;          /* so many calls fail                             */
static bool named = true;  /* the folder was synced after the last rename    */
static enum kind kind;

/* Does this call fail? */
static bool is_bad(void)
{
	calls++;
	if (!fail_at || calls < fail_at || calls - fail_at >= times)
		return false;
	errno = kind == FULL ? ENOSPC : kind == SIGNAL ? EINTR : EIO;
	return true;
}

/* Those that write nothing know no half, and of a full disk only those that make a file fail. */
static bool is_bad_otherwise(bool makes)
{
	return is_bad() && kind != HALF && (kind != FULL || makes) && kind != SIGNAL;
}

#define WRAP(type, name, with, ...) \
	type __real_##name with; \
	type __wrap_##name with; \
	type __wrap_##name with { __VA_ARGS__ }
WRAP(int, open, (const char *path, int flags, ...),
	va_list more;
	int mode = 0;
	if (flags & O_CREAT) {
		va_start(more, flags);
		mode = va_arg(more, int);
		va_end(more);
	}
	return is_bad_otherwise(flags & O_CREAT) ? -1 : __real_open(path, flags, mode);)
WRAP(int, open64, (const char *path, int flags, ...),
	va_list more;
	int mode = 0;
	if (flags & O_CREAT) {
		va_start(more, flags);
		mode = va_arg(more, int);
		va_end(more);
	}
	return is_bad_otherwise(flags & O_CREAT) ? -1 : __real_open64(path, flags, mode);)
WRAP(int, mkstemp, (char *path), return is_bad_otherwise(true) ? -1 : __real_mkstemp(path);)
WRAP(int, mkstemp64, (char *path), return is_bad_otherwise(true) ? -1 : __real_mkstemp64(path);)
WRAP(int, fsync, (int fd),
	struct stat about;
	if (is_bad_otherwise(true))
		return -1;
	named |= fstat(fd, &about) == 0 && S_ISDIR(about.st_mode);
	return __real_fsync(fd);)
WRAP(ssize_t, read, (int fd, void *out, size_t len), return is_bad_otherwise(false) ? -1 : __real_read(fd, out, len);)
WRAP(ssize_t, pread, (int fd, void *out, size_t len, off_t at),
	return is_bad_otherwise(false) ? -1 : __real_pread(fd, out, len, at);)
WRAP(ssize_t, pread64, (int fd, void *out, size_t len, off_t at),
	return is_bad_otherwise(false) ? -1 : __real_pread64(fd, out, len, at);)
WRAP(int, fdatasync, (int fd), return is_bad_otherwise(true) ? -1 : __real_fdatasync(fd);)
WRAP(int, ftruncate, (int fd, off_t len), return is_bad_otherwise(false) ? -1 : __real_ftruncate(fd, len);)
WRAP(int, ftruncate64, (int fd, off_t len), return is_bad_otherwise(false) ? -1 : __real_ftruncate64(fd, len);)
WRAP(int, rename, (const char *from, const char *to),
	if (is_bad_otherwise(true))
		return -1;
	named = false;
	return __real_rename(from, to);)
WRAP(ssize_t, write, (int fd, const void *bytes, size_t len),
	return !is_bad() ? __real_write(fd, bytes, len) : kind != HALF ? -1 :
		__real_write(fd, bytes, len > 1 ? len / 2 : len);)
WRAP(ssize_t, pwrite, (int fd, const void *bytes, size_t len, off_t at),
	return !is_bad() ? __real_pwrite(fd, bytes, len, at) : kind != HALF ? -1 :
		__real_pwrite(fd, bytes, len > 1 ? len / 2 : len, at);)
WRAP(ssize_t, pwrite64, (int fd, const void *bytes, size_t len, off_t at),
	return !is_bad() ? __real_pwrite64(fd, bytes, len, at) : kind != HALF ? -1 :
		__real_pwrite64(fd, bytes, len > 1 ? len / 2 : len, at);)

/* What ladderd says: its stderr. */
static FILE *real_stderr;
static char *said;
static size_t said_len;

static void listen_to_it(void)
{
	fflush(stderr);
	if (stderr != real_stderr)
		fclose(stderr);
	free(said);
	said = NULL;
	stderr = open_memstream(&said, &said_len);
}

static bool has_said(const char *what)
{
	fflush(stderr);
	return said && strstr(said, what);
}

static char folder[] = "/tmp/disksXXXXXX";

static const char *file_of(const char *name)
{
	static char path[2][100];
	static int turn;

	turn = !turn;
	snprintf(path[turn], sizeof(path[turn]), "%s/%s", folder, name);
	return path[turn];
}

static size_t get(const char *name, uint8_t *out, size_t size)
{
	FILE *in = fopen(file_of(name), "rb");
	const size_t len = in ? fread(out, 1, size, in) : 0;

	if (in)
		fclose(in);
	return len;
}

static void put(const char *name, const uint8_t *bytes, size_t len)
{
	FILE *out = fopen(file_of(name), "wb");

	if (!out || fwrite(bytes, 1, len, out) != len || fclose(out) != 0)
		abort();
}

static void clear(void)
{
	static const char *const name[] = { "keep", "keep.new", "keep.old", "events", "ends", "conf",
					    "password", "password.new", "prog.A", "prog.B",
					    "prog.A.new", "prog.B.new", "alarms" };

	for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++)
		unlink(file_of(name[i]));
}

/* ---- what stands in for the rest of ladderd ---- */

bool load_texts(struct load *load, const void *program, size_t program_len, const char *map,
		size_t map_len)
{
	(void)load, (void)program, (void)program_len, (void)map, (void)map_len;
	return true;
}

bool load_files(struct load *load, const char *file, const char *map, bool watch)
{
	(void)load, (void)file, (void)map, (void)watch;
	return true;
}

bool options_set(struct options *options, const char *name, const char *value)
{
	(void)options, (void)name, (void)value;
	return true;
}

bool crypt_can(void)
{
	return true;
}

bool crypt_make(const char *text, char *out)
{
	snprintf(out, PASSWORD_HASH, "%s", text);
	return true;
}

enum crypt_end crypt_compare(const char *text, const char *hash)
{
	return strcmp(text, hash) == 0 ? CRYPT_FITS : CRYPT_DIFFERS;
}

/* ---- retained values ---- */

static struct rig rig;
static struct arena plan_arena;
static struct retain retain;
static uint8_t *copy;

/* Stores @first, … @last as a run of ladderd does. Returns the last one that was told to be
 * stored, -1: the name of its file was not; *found: the value that it began with, 0: none. */
static int keep(int first, int last, uint32_t room, int *found_value)
{
	struct store_file file;
	struct retain_found found;
	struct arena arena;
	struct retain_record record;
	uint32_t at = RETAIN_HEAD;
	int32_t value = 0;
	uint8_t *bytes;
	size_t len;
	int stored = 0;

	arena_init(&arena);
	store_file_open(&file, file_of("keep"), &arena, &bytes, &len);
	retain_find(bytes ? bytes : (const uint8_t *)"", bytes ? len : 0, &found);
	if (found.best >= 0 && retain_next(found.payload, found.len, &at, &record))
		memcpy(&value, record.value, sizeof(value));
	store_file_adopt(&file, &found, room);
	store_file_prepare(&file);
	for (int i = first; i <= last; i++) {
		rig_set(&rig, "A", i);
		rig_set(&rig, "B", i);
		retain_copy(&retain, &rig.resource.image, copy);
		retain_fill(&retain, copy, i);
		if (store_file_write(&file, &retain) == 0)
			stored = named && stored >= 0 ? i : -1;
	}
	free(bytes);
	store_file_close(&file);
	arena_free(&arena);
	*found_value = value;
	return stored;
}

static uint32_t room;

static void keep_good(void)
{
	int before;

	if (keep(1, 5, retain_room(retain.payload_size), &before) != 5)
		abort();
}

static bool keep_bad(void)
{
	int before, stored, after, again;
	bool aside;

	stored = keep(6, 8, room, &before);
	fail_at = 0;
	aside = access(file_of("keep.old"), F_OK) == 0;
	if (stored < 0 || keep(1, 0, room, &after) != 0 || after < (stored ? stored : before ? 5 : 0))
		return false;
	if (!before && times == 1)
		return false; /* it could have asked again */
	/* A start that could not read the old values did not take their place. */
	if (!before && after != 5 && !aside)
		return false;
	return keep(20, 21, room, &before) == 21 && keep(1, 0, room, &again) == 0 && again == 21;
}

/* ---- the log ---- */

static void log_good(void)
{
	struct journal *journal = journal_open(folder);

	for (int i = 0; i < 3; i++)
		journal_add(journal, EVENT_WRITE, 0, "u", "before", "");
	journal_close(journal);
}

static int events_of(const char *word)
{
	struct journal *journal = journal_open(folder);
	struct event event = { .seq = 0 };
	uint32_t seq = 0;
	int count = 0;

	while (journal_next(journal, seq + 1, &event)) {
		seq = event.seq;
		count += strcmp(event.arg[0], word) == 0;
	}
	journal_close(journal);
	return count;
}

static bool log_bad(void)
{
	struct journal *journal = journal_open(folder);
	bool told = true;
	int64_t now_ns = 0;

	for (int i = 0; i < 6; i++) {
		journal_add(journal, EVENT_WRITE, 0, "u", "meanwhile", "");
		journal_sync(journal, now_ns += 2 * SECOND);
	}
	if (fail_at && times > CALLS_MOST && calls >= fail_at && kind == BROKEN)
		told = journal_error(journal) == EIO && has_said("events are not stored");
	fail_at = 0;
	journal_sync(journal, now_ns += 2 * SECOND);
	told &= journal_error(journal) == 0;
	/* As after a kill: nothing is written at its end. */
	told &= events_of("meanwhile") == 6;
	journal_close(journal);
	/* A log that could not be read is told; its records are written over at most where new
	 * ones are. */
	return told && (events_of("before") == 3 || (times > 1 && (has_said("events are not stored") ||
								   has_said("cannot be read"))));
}

/* ---- alarms ---- */

static struct alarm_store alarms;
static struct alarm_list alarm_list;

static void open_alarms(void)
{
	memset(&alarm_list, 0, sizeof(alarm_list));
	memset(&alarms, 0, sizeof(alarms));
	alarm_store_open(&alarms, folder, &alarm_list, 1);
}

static void add_alarms(const char *word, int count)
{
	for (int i = 0; i < count; i++) {
		struct alarm_note note = { .state = ALARM_UNACK, .class = 1, .times = 1, .time_ns = 1 };

		snprintf(note.name, sizeof(note.name), "%s%d", word, i);
		alarm_list_note(&alarm_list, &note);
	}
}

/* Each row once, and no two with the same number. */
static int alarms_of(const char *word)
{
	int count = 0;

	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		const struct alarm_row *row = &alarm_list.row[i];

		if (!row->number || row->number > alarm_list.last ||
		    strncmp(row->name, word, strlen(word)) != 0)
			continue;
		count += alarm_list_find(&alarm_list, row->number) == row;
	}
	return count;
}

static void alarms_good(void)
{
	open_alarms();
	add_alarms("before", 3);
	alarm_store_close(&alarms, &alarm_list);
}

static bool alarms_bad(void)
{
	bool told = true;
	int64_t now_ns = 0;

	open_alarms();
	for (int i = 1; i <= 3; i++) {
		add_alarms("meanwhile", i);
		alarm_store_write(&alarms, &alarm_list, now_ns += 20 * SECOND);
	}
	if (fail_at && times > CALLS_MOST && calls >= fail_at && kind == BROKEN)
		told = alarms.error == EIO && has_said("alarms are not stored");
	fail_at = 0;
	alarm_store_write(&alarms, &alarm_list, now_ns += 20 * SECOND);
	told &= alarms.error == 0 && !alarm_list.changed;
	close(alarms.fd); /* as after a kill */
	open_alarms();
	told &= alarms_of("meanwhile") == 3;
	told &= alarms_of("before") == 3 || (times > 1 && has_said("rows are damaged and are lost"));
	alarm_store_close(&alarms, &alarm_list);
	return told;
}

/* ---- abnormal ends ---- */

static void ends_good(void)
{
	ends_begin(folder);
}

static bool ends_bad(void)
{
	bool many = ends_begin(folder) == EVENT_ENDS;

	many |= ends_begin(folder) == EVENT_ENDS;
	if (many) /* two ends, not three */
		return false;
	many = ends_begin(folder) == EVENT_ENDS;
	fail_at = 0;
	return many || (times > 1 && (has_said("abnormal ends are not counted") ||
				      has_said("are forgotten") || kind == BROKEN));
}

/* ---- settings ---- */

static struct options options;

static enum refusal set_name(struct conf *conf, const char *name)
{
	struct setting changed;
	char detail[200];

	options = (struct options){ .slots = folder };
	conf_load(conf, &options);
	return conf_change(conf, "name", name, &changed, detail, sizeof(detail));
}

static void conf_good(void)
{
	struct conf conf;

	set_name(&conf, "old");
}

static bool conf_bad(void)
{
	struct conf conf;
	const enum refusal end = set_name(&conf, "new");
	const bool damaged = conf.damaged;

	fail_at = 0;
	options = (struct options){ .slots = folder };
	conf_load(&conf, &options);
	if (end != REFUSAL_NONE && times == 1)
		return false; /* it could have asked again */
	return !conf.damaged && (!damaged || times > 1) && (!damaged || has_said("damaged")) &&
	       strcmp(options.name, end == REFUSAL_NONE ? "new" : "old") == 0;
}

/* ---- the password ---- */

static enum refusal set_password(const char *old, const char *text)
{
	static struct password password;
	char detail[100];

	password_load(&password, folder);
	return password_change(&password, 1, old, text, 0, detail, sizeof(detail));
}

static void password_good(void)
{
	set_password("", "old");
}

static bool password_bad(void)
{
	static struct password password;
	char detail[100];
	const enum refusal end = set_password("old", "new");

	fail_at = 0;
	if (end != REFUSAL_NONE && times == 1)
		return false; /* it could have asked again */
	password_load(&password, folder);
	return password_check(&password, 1, end == REFUSAL_NONE ? "new" : "old", 0, detail,
			      sizeof(detail)) == REFUSAL_NONE;
}

/* ---- programs ---- */

static struct stored program;

static bool download(uint32_t *began)
{
	static struct load load;
	static struct slots slots;
	static uint8_t bytes[65536];
	const size_t len = SLOT_HEAD + stored_size(&program) + 4u;
	struct diag_list diags;
	const uint8_t beside[32] = { 0 };
	bool stopped = false, good;

	diag_init(&diags);
	options = (struct options){ .slots = folder };
	slots_load(&slots, &options, &load, &stopped);
	*began = slots.seq;
	slot_seal(&program, slots.seq + 1, beside, bytes);
	good = slots_store(&slots, bytes, len, &diags) && slots_keep(&slots);
	if (!good)
		slots_drop(&slots);
	slots_close(&slots);
	return good;
}

static uint32_t newest(bool *bad)
{
	static struct load load;
	static struct slots slots;
	bool stopped = false;

	options = (struct options){ .slots = folder, .check = true };
	slots_load(&slots, &options, &load, &stopped);
	slots_close(&slots);
	*bad = slots.bad[0] || slots.bad[1];
	return slots.seq;
}

static void slots_good(void)
{
	uint32_t began;

	download(&began);
	download(&began);
}

static bool slots_bad(void)
{
	uint32_t began;
	bool bad;
	const bool good = download(&began);

	fail_at = 0;
	if ((began < 2 || !good) && times == 1)
		return false; /* it could have asked again */
	if (began < 2 && !has_said("is damaged and is not used"))
		return false; /* it ran an older one, and nobody heard of it */
	return newest(&bad) == (good ? began + 1 : 2) && !bad;
}

/* ---- all of them ---- */

static const struct scenario {
	const char *name, *file;
	void (*good)(void);
	bool (*bad)(void);
} scenario[] = {
	{ "retained values", "keep", keep_good, keep_bad },
	{ "the log", "events", log_good, log_bad },
	{ "alarms", "alarms", alarms_good, alarms_bad },
	{ "abnormal ends", "ends", ends_good, ends_bad },
	{ "settings", "conf", conf_good, conf_bad },
	{ "the password", "password", password_good, password_bad },
	{ "programs", "prog.B", slots_good, slots_bad },
};

static bool try(const struct scenario *it, int at)
{
	bool good;

	clear();
	fail_at = 0;
	it->good();
	listen_to_it();
	calls = 0;
	fail_at = at;
	good = it->bad();
	fail_at = 0;
	return good;
}

static void fail_everywhere(const struct scenario *it)
{
	char what[120];
	int wrong = 0, tries = 0;

	for (int k = 0; k < KINDS; k++)
		for (int how = 0; how < (k == SIGNAL ? 1 : 3); how++) {
			kind = k;
			times = how == 0 ? 1 : how == 1 ? 3 : 10 * CALLS_MOST;
			for (int at = 1; at < CALLS_MOST; at++, tries++) {
				if (!try(it, at)) {
					printf("# %s: %s, %d times from call %d on\n", it->name, kind_name[k],
					       times, at);
					wrong++;
				}
				if (calls < at)
					break;
			}
		}
	snprintf(what, sizeof(what), "%s: a disk that fails at any of %d calls", it->name, tries);
	CHECK_AS(!wrong && tries > 8, what);
}

/* ---- damage ---- */

/* Loads everything. False: it is neither as it was nor told to be damaged. */
static bool is_told(const struct scenario *it, const uint8_t *was, size_t len)
{
	static uint8_t now[20000];
	int value;
	bool bad = false, told;
	const size_t got = get(it->file, now, sizeof(now));

	if (got == len && memcmp(was, now, len) == 0)
		return true;
	listen_to_it();
	if (strcmp(it->file, "keep") == 0) {
		keep(1, 0, room, &value);
		return value == 0 || value == 4 || value == 5;
	}
	if (strcmp(it->file, "alarms") == 0) {
		open_alarms();
		told = alarms_of("before") == 3 || has_said("rows are damaged and are lost") ||
		       got < len;
		close(alarms.fd);
		return told;
	}
	if (strcmp(it->file, "events") == 0)
		return events_of("before") <= 3;
	if (strcmp(it->file, "ends") == 0)
		told = !ends_begin(folder) && (!got || has_said("is damaged"));
	else if (strcmp(it->file, "conf") == 0) {
		struct conf conf;

		options = (struct options){ .slots = folder };
		conf_load(&conf, &options);
		told = conf.damaged && !*options.name && has_said("is damaged");
	} else if (strcmp(it->file, "password") == 0) {
		static struct password password;
		char detail[100];

		password_load(&password, folder);
		told = password_check(&password, 1, "old", 0, detail, sizeof(detail)) != REFUSAL_NONE ||
		       (got && now[0] == 'o');
	} else {
		told = newest(&bad) == 1 && bad && has_said("is damaged and is not used");
	}
	return told;
}

static void damage(const struct scenario *it)
{
	static uint8_t was[20000], now[20000];
	char what[120];
	uint32_t random = 1;
	int wrong = 0;
	size_t len;

	clear();
	it->good();
	len = get(it->file, was, sizeof(was));
	for (size_t cut = 0; cut < len; cut += len > 4096 && cut > 64 ? 13 : 1) {
		put(it->file, was, cut);
		wrong += !is_told(it, was, len);
	}
	for (int i = 0; i < 500; i++) {
		memcpy(now, was, len);
		for (int bits = 1 + i % 3; bits--;) {
			random = random * 1664525u + 1013904223u;
			now[(random >> 8) % len] ^= (uint8_t)(1u << (random >> 3 & 7));
		}
		put(it->file, now, len);
		wrong += !is_told(it, was, len);
	}
	snprintf(what, sizeof(what), "%s: a file of %zu bytes that was cut or damaged", it->name, len);
	CHECK_AS(!wrong && len, what);
}

/* ---- each event ---- */

static const char hostile[] = "\n\x1b[2J%s%n\"\t{}\x7f end";

/* Events in the log from number @first on, one after another without a gap. */
static uint32_t follow(uint32_t first, struct event *last)
{
	struct journal *journal = journal_open(folder);
	uint32_t count = 0;

	while (journal_next(journal, first + count, last) && last->seq == first + count)
		count++;
	journal_close(journal);
	return count;
}

static void each_event(void)
{
	static const uint8_t id[] = {
#define EVENT(name, number, text) number,
#include "online/events.def"
	};
	const uint32_t kinds = sizeof(id);
	struct event event;
	char line[400];
	int wrong = 0;

	clear();
	for (uint32_t i = 0; i < kinds; i++) {
		struct journal *journal = journal_open(folder);

		journal_add(journal, (enum event_id)id[i], 3, hostile, hostile, "two");
		/* As after a kill: it is not closed yet. */
		wrong += follow(i + 1, &event) != 1 || event.id != id[i] || event.role != 3 ||
			 strcmp(event.user, hostile) != 0 || strcmp(event.arg[0], hostile) != 0;
		event_print(&event, line, sizeof(line));
		for (const char *at = line; *at; at++)
			wrong += (unsigned char)*at < ' ' || *at == 127;
		journal_close(journal);
	}
	CHECK_AS(!wrong, "each event is one record, also after a kill, and no text breaks its line");
	{
		struct journal *journal = journal_open(folder);

		for (uint32_t i = 0; i < EVENT_RING; i++)
			journal_add(journal, EVENT_WRITE, 3, "u", "full", "");
		CHECK_AS(follow(kinds + 1, &event) == EVENT_RING && event.seq == kinds + EVENT_RING,
			 "a log that is full has the newest ones, each once");
		journal_close(journal);
	}
}

int main(void)
{
	const uint8_t *image;
	uint8_t *bytes;
	size_t len;

	real_stderr = stderr;
	if (!mkdtemp(folder) || !rig_open(&rig, "VAR_GLOBAL RETAIN\n  A : DINT;\n  B : DINT;\nEND_VAR\n"
					  "PROGRAM Main LD\nRUNG\n  | [ A := B ] |\nEND_PROGRAM\n", false))
		abort();
	arena_init(&plan_arena);
	if (!retain_plan(&retain, &rig.resource.image, &plan_arena))
		abort();
	copy = arena_alloc(&plan_arena, retain.copy_size);
	image = ladder_image(rig.ladder, &len);
	bytes = malloc(len + 1);
	if (!bytes || !copy)
		abort();
	memcpy(bytes, image, len);
	program = (struct stored){ .len = { (uint32_t)len }, .bytes = bytes };
	room = retain_room(retain.payload_size);
	for (size_t i = 0; i < sizeof(scenario) / sizeof(scenario[0]); i++)
		fail_everywhere(&scenario[i]);
	room *= 2; /* another program: the file is replaced by a larger one */
	fail_everywhere(&(struct scenario){ "more retained values", "keep", keep_good, keep_bad });
	room /= 2;
	for (size_t i = 0; i < sizeof(scenario) / sizeof(scenario[0]); i++)
		damage(&scenario[i]);
	each_event();
	clear();
	rmdir(folder);
	fclose(stderr);
	stderr = real_stderr;
	free(said);
	free(bytes);
	arena_free(&plan_arena);
	rig_close(&rig);
	return tap_done();
}
