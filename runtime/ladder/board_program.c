/* SPDX-License-Identifier: MIT
 *
 * board_program - download and upload of `ladder board`, the first one also of `ladder push`:
 * a program, its I/O map and its sources go to a board and come back.
 */
#define _XOPEN_SOURCE 700 /* mkdir() */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include "engine/exchange/image/image_il.h"
#include "ladder/tty.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"
#include "engine/scan/carry.h"
#include "engine/scan/resource.h"
#include "hal/iomap.h"
#include "online/send.h"
#include "online/stored.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- the parts of a download ---- */

/* The folder of the program, with its slash: that of its file, or of all its files. */
static size_t folder_len(const struct project *project)
{
	const char *first = project->source->name;
	size_t len = strlen(first);

	for (int i = 0; i < project->source_count; i++)
		while (len > 0 && (first[len - 1] != '/' ||
				   strncmp(project->source[i].name, first, len) != 0))
			len--;
	return len;
}

/* The name that a file has in the sources: from the folder of the program on. */
static const char *source_name(const char *path, const char *first, size_t folder)
{
	const char *own = strrchr(path, '/');

	if (strncmp(path, first, folder) == 0 && !strstr(path + folder, "..") &&
	    path[folder] != '/')
		return path + folder;
	return own ? own + 1 : path;
}

static bool add_source(struct bytes *bytes, const char *path, const struct project *project)
{
	const char *name = source_name(path, project->source->name, folder_len(project));
	uint8_t head[6];
	struct wire_writer out = wire_write(head, sizeof(head));
	size_t len;
	char *text = report_read(path, &len);

	if (!text)
		return false;
	wire_put_u16(&out, (uint16_t)strlen(name));
	bytes_add(bytes, head, 2);
	bytes_add(bytes, name, strlen(name));
	wire_put_u32(&out, (uint32_t)len);
	bytes_add(bytes, head + 2, 4);
	bytes_add(bytes, text, len);
	free(text);
	return true;
}

/* u16 how many, and for each a text, u32 length, bytes. A code image has none, nor has a project
 * of another tool. */
static bool add_sources(struct bytes *bytes, struct ladder *ladder)
{
	const struct project *project = ladder_import_report(ladder) ? NULL :
				       ladder_project(ladder);
	const uint16_t count = project ? (uint16_t)(project->source_count + project->included_count +
						    project->used_count) : 0;
	const uint8_t head[2] = { (uint8_t)count, (uint8_t)(count >> 8) };
	bool good = true;

	bytes_add(bytes, head, sizeof(head));
	if (!project)
		return true;
	for (int i = 0; i < project->source_count && good; i++)
		good = add_source(bytes, project->source[i].name, project);
	for (int i = 0; i < project->included_count && good; i++)
		good = add_source(bytes, project->included[i], project);
	for (int i = 0; i < project->used_count && good; i++)
		good = add_source(bytes, project->used[i], project);
	return good;
}

/* @program: NULL if it has errors; then only the map itself is checked. */
static enum status read_map(const char *path, const struct program *program, char **text,
			    size_t *len)
{
	struct diag_list *diags = report_list(path);
	struct arena arena;
	struct iomap map;
	bool good = false;

	if (!diags)
		return STATUS_WRONG;
	arena_init(&arena);
	*text = report_read(path, len);
	if (*text)
		good = iomap_read(&map, &arena, path, *text, *len, diags) &&
		       (!program || iomap_check_program(&map, program, &arena, diags));
	report_end(diags);
	arena_free(&arena);
	return good ? STATUS_GOOD : *text ? STATUS_NO : STATUS_WRONG;
}

/* Image, map and sources, one after another. */
static enum status gather(struct parcel *parcel, const char *path, const char *map)
{
	struct bytes *bytes = &parcel->bytes;
	size_t image_len;
	const void *image = ladder_image(parcel->machine.ladder, &image_len);
	enum status status = STATUS_GOOD;

	bytes_add(bytes, image, image_len);
	bytes_add(bytes, map, parcel->map_len);
	if (!add_sources(bytes, parcel->machine.ladder))
		status = STATUS_WRONG;
	if (bytes->failed)
		return report_no_memory(path);
	parcel->stored.len[STORED_IMAGE] = (uint32_t)image_len;
	parcel->stored.len[STORED_MAP] = (uint32_t)parcel->map_len;
	parcel->stored.len[STORED_SOURCES] = (uint32_t)(bytes->len - image_len - parcel->map_len);
	parcel->stored.bytes = bytes->at;
	return status;
}

enum status parcel_open(struct parcel *parcel, const char *path, const char *map_path)
{
	enum status status, map_status;
	char *map = NULL;

	memset(parcel, 0, sizeof(*parcel));
	/* Both are read, so that one call reports all errors. */
	status = machine_open(&parcel->machine, path, MACHINE_AS_FILE | MACHINE_WATCHED);
	map_status = read_map(map_path, status == STATUS_GOOD ?
			      ladder_program(parcel->machine.ladder) : NULL, &map,
			      &parcel->map_len);
	if (status < map_status)
		status = map_status;
	if (status == STATUS_GOOD)
		status = gather(parcel, path, map);
	free(map);
	if (status == STATUS_GOOD && !stored_size(&parcel->stored)) {
		report_diag((struct diag){ .id = DIAG_STORED_TOO_LARGE, .file = path }, "%u",
			    (unsigned)(STORED_MOST >> 20));
		status = STATUS_WRONG;
	}
	return status;
}

void parcel_close(struct parcel *parcel)
{
	machine_close(&parcel->machine);
	free(parcel->bytes.at);
}

/* ---- download ---- */

/* Sends a program, and prints how much went or why not. */
static enum status send_all(struct remote *remote, const struct stored *stored, bool all,
			    struct sent *sent)
{
	const enum desk_end end = send_program(&remote->desk, stored, all, sent);

	if (end == DESK_GOOD)
		sink_printf(&remote->call->out, "sent %u of %u bytes\n", (unsigned)sent->bytes,
			    (unsigned)stored_size(stored));
	if (end == DESK_REFUSED && remote->put.or_else && remote->desk.refusal == REFUSAL_NO_STORE) {
		remote->put.no_store = true;
		return STATUS_NO;
	}
	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

static const char *loss_text(uint8_t reason)
{
	static const char *const text[] = {
		[CARRY_GONE] = "is not in the new program; its value is lost",
		[CARRY_NEW] = "is new; it starts with its initial value",
		[CARRY_TYPE] = "has another type; it starts with its initial value",
		[CARRY_BLOCK] = "is an instance of another block; it starts anew",
		[CARRY_TEXT] = "has less room; it starts with its initial value",
		[CARRY_FORCE] = "is forced; the force ends",
	};

	return reason < sizeof(text) / sizeof(text[0]) ? text[reason] : "changes";
}

/* What a person would not expect to lose: a new variable loses nothing. */
static bool is_loss(uint8_t reason)
{
	return reason != CARRY_NEW;
}

struct verified {
	bool same_map;
	uint8_t program[32];
	uint32_t losses;
};

enum status remote_send(struct remote *remote, const struct stored *stored,
			struct wire_reader *verified)
{
	struct wire_writer out;
	enum desk_end end;
	struct sent sent = { .go_on = NULL };
	enum status status = send_all(remote, stored, false, &sent);

	if (status != STATUS_GOOD)
		return status;
	out = desk_ask(&remote->desk, SERVICE_VERIFY);
	end = desk_call(&remote->desk, &out, verified);
	if (end == DESK_REFUSED && remote->desk.refusal == REFUSAL_NOT_WHOLE && sent.copied) {
		/* Another program runs by now, or two blocks had the same sums. */
		status = send_all(remote, stored, true, &sent);
		if (status != STATUS_GOOD)
			return status;
		out = desk_ask(&remote->desk, SERVICE_VERIFY);
		end = desk_call(&remote->desk, &out, verified);
	}
	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

static enum status verify(struct remote *remote, const struct stored *stored,
			  struct verified *verified)
{
	const struct sink *sink = &remote->call->out;
	struct wire_reader in;
	const enum status status = remote_send(remote, stored, &in);
	const uint8_t *program;
	uint32_t count, told;

	if (status != STATUS_GOOD)
		return status;
	verified->same_map = wire_u8(&in);
	program = wire_bytes(&in, sizeof(verified->program));
	if (program)
		memcpy(verified->program, program, sizeof(verified->program));
	count = wire_u32(&in);
	told = wire_u32(&in);
	verified->losses = count > told ? count - told : 0;
	for (uint32_t i = 0; i < told && !in.failed; i++) {
		const uint8_t reason = wire_u8(&in);
		size_t len;
		const char *name = wire_text(&in, &len);

		verified->losses += is_loss(reason);
		foreign_write(sink, name, len);
		sink_printf(sink, " %s\n", loss_text(reason));
	}
	if (count > told)
		sink_printf(sink, "and %u more\n", (unsigned)(count - told));
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

/* Asks on the terminal; without one the answer is no. */
bool remote_is_wanted(struct remote *remote, const char *question)
{
	char answer[16];

	if (call_flag(remote->call, "--yes"))
		return true;
	if (!isatty(STDIN_FILENO)) {
		report_usage(remote->call, "say --yes, or answer at a terminal");
		return false;
	}
	report_flush(remote->call);
	fprintf(stderr, "%s [y/N] ", question);
	return fgets(answer, sizeof(answer), stdin) && (*answer == 'y' || *answer == 'Y');
}

/* The board tells that another program runs, and why if no desk put it there. */
static void take_change(void *context, const struct frame *frame)
{
	struct remote *remote = context;
	struct wire_reader in = frame->body;

	if (frame->service == SERVICE_COMMIT && wire_left(&in))
		wire_copy_text(&in, remote->why, sizeof(remote->why));
}

/* Waits until the new program has run for @back scans, or has gone. */
static enum status wait_for_trial(struct remote *remote, uint32_t back)
{
	struct board_status *now = calloc(1, sizeof(*now));
	enum status status = now ? STATUS_GOOD : report_no_memory(remote->where);
	enum desk_end end = DESK_LATE;
	uint64_t first = 0;

	while (status == STATUS_GOOD && !*remote->why && (end == DESK_GOOD || end == DESK_LATE)) {
		status = remote_status(remote, now);
		if (!first)
			first = now->scans;
		if (status != STATUS_GOOD || *remote->why || now->mode != STATE_RUN ||
		    now->scans > first + back)
			break;
		end = desk_listen(&remote->desk, 100);
	}
	free(now);
	if (status != STATUS_GOOD)
		return status;
	if (*remote->why)
		report_diag((struct diag){ .id = DIAG_LINK_WENT_BACK, .file = remote->where },
			    "%.150s", remote->why);
	return *remote->why ? STATUS_NO : STATUS_GOOD;
}

enum status remote_commit(struct remote *remote, enum commit_how how, uint32_t back)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_COMMIT);
	struct wire_reader in;
	enum desk_end end;

	wire_put_expect(&out, &remote->expect);
	wire_put_u8(&out, (uint8_t)how);
	if (back)
		wire_put_u32(&out, back);
	remote->desk.told = take_change;
	remote->desk.context = remote;
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	return back ? wait_for_trial(remote, back) : STATUS_GOOD;
}

/* 0: not wanted. */
static bool read_back(const struct call *call, uint32_t *back)
{
	const char *text = call_option(call, "--back-within");
	char *end;
	unsigned long long number;

	*back = 0;
	if (!text)
		return true;
	number = strtoull(text, &end, 10);
	*back = (uint32_t)number;
	if (*text >= '0' && *text <= '9' && !*end && number > 0 && number <= UINT32_MAX &&
	    !call_flag(call, "--restart"))
		return true;
	report_usage(call, "--back-within needs a number of scans, and no --restart");
	return false;
}

enum status remote_put(struct remote *remote, const struct parcel *parcel)
{
	struct put *put = &remote->put;
	struct board_status *now = calloc(1, sizeof(*now));
	struct verified verified = { .losses = 0 };
	enum status status = now ? remote_status(remote, now) : report_no_memory(remote->where);
	const bool runs = status == STATUS_GOOD && now->mode == STATE_RUN;
	uint32_t back = 0;

	free(now);
	remote->expect.mode = EXPECT_ANY;
	if (status == STATUS_GOOD && !read_back(remote->call, &back))
		status = STATUS_WRONG;
	if (status == STATUS_GOOD)
		status = verify(remote, &parcel->stored, &verified);
	if (status != STATUS_GOOD)
		return status;
	memcpy(put->program, verified.program, sizeof(put->program));
	if (put->or_restart && (!verified.same_map || !runs)) {
		put->restart = true;
		sink_text(&remote->call->out, runs ? "the lines of the new I/O map need a restart; the "
			  "board begins again\n" : "the board does not run; it begins again\n");
	}
	if (put->ask && !put->restart && verified.losses &&
	    !remote_is_wanted(remote, "Values would be lost. Download?"))
		return STATUS_NO;
	return remote_commit(remote, put->restart ? COMMIT_RESTART : COMMIT_LIVE, back);
}

enum status remote_download(struct remote *remote)
{
	const struct call *call = remote->call;
	struct parcel parcel;
	enum status status;

	if (call->arg_count != 4)
		return report_usage(call, "download needs FILE and MAP");
	remote->put = (struct put){ .ask = true, .restart = call_flag(call, "--restart") };
	status = parcel_open(&parcel, call->arg[2], call->arg[3]);
	if (status == STATUS_GOOD)
		status = remote_put(remote, &parcel);
	parcel_close(&parcel);
	return status;
}

/* ---- upload ---- */

enum status remote_receive(struct remote *remote, struct stored *stored, struct bytes *bytes)
{
	uint32_t size;
	bool asked = false;

	do {
		struct wire_writer out = desk_ask(&remote->desk, SERVICE_UPLOAD);
		struct wire_reader in;
		enum desk_end end;
		size_t len;

		wire_put_u32(&out, (uint32_t)bytes->len);
		end = desk_call(&remote->desk, &out, &in);
		if (end == DESK_REFUSED && remote->desk.refusal == REFUSAL_PASSWORD && !asked) {
			const enum status status = remote_unlock(remote);

			if (status != STATUS_GOOD)
				return status;
			asked = true;
			size = UINT32_MAX;
			continue;
		}
		if (end != DESK_GOOD)
			return remote_fail(remote, end);
		for (int i = 0; i < STORED_PARTS; i++)
			stored->len[i] = wire_u32(&in);
		size = stored_size(stored);
		len = wire_left(&in);
		if (!in.failed && !stored->len[STORED_IMAGE])
			return remote_tell(remote, DIAG_LINK_NO_PROGRAM);
		if (in.failed || !size || len > size - bytes->len || (!len && bytes->len < size))
			return remote_fail(remote, DESK_NONSENSE);
		bytes_add(bytes, wire_bytes(&in, len), len);
		if (bytes->failed)
			return report_no_memory(remote->where);
	} while (bytes->len < size);
	stored->bytes = bytes->at;
	return STATUS_GOOD;
}

/* A name that stays below the folder: no way up, no other root, no control character. */
static bool is_safe(const char *name, size_t len)
{
	if (!len || len > 200 || *name == '/' || *name == '.')
		return false;
	for (size_t i = 0; i < len; i++) {
		if ((unsigned char)name[i] < ' ' || name[i] == 127 || name[i] == '\\')
			return false;
		if (name[i] == '/' && (i + 1 == len || name[i + 1] == '/' || name[i + 1] == '.'))
			return false;
	}
	return true;
}

/* Makes the folders of @path behind its first @from bytes. */
static void make_folders(char *path, size_t from)
{
	for (char *slash = strchr(path + from, '/'); slash; slash = strchr(slash + 1, '/')) {
		*slash = '\0';
		mkdir(path, 0777); /* if it fails, the file cannot be written, and that is said */
		*slash = '/';
	}
}

/* A file of an upload. */
struct upload_file {
	const char *name; /* not ended by a 0 */
	size_t name_len;
	const uint8_t *bytes;
	size_t len;
};

/* An upload on its way to the disk. */
struct upload {
	struct remote *remote;
	const char *folder;
	const struct stored *stored;
	const char *list; /* made from the image of a board without sources; or NULL */
	/* What is done with each file. */
	enum status (*step)(const struct upload *upload, const struct upload_file *file);
};

static bool upload_path(const struct upload *upload, const struct upload_file *file,
			char path[static 1400])
{
	const int used = snprintf(path, 1400, "%.1000s/%.*s", upload->folder,
				  (int)file->name_len, file->name);

	return is_safe(file->name, file->name_len) && used < 1400;
}

static enum status refuse_known(const struct upload *upload, const struct upload_file *file)
{
	char path[1400];

	if (!upload_path(upload, file, path))
		return remote_fail(upload->remote, DESK_NONSENSE);
	if (access(path, F_OK) != 0)
		return STATUS_GOOD;
	report_diag((struct diag){ .id = DIAG_FILE_EXISTS, .file = path }, "%s", "");
	return STATUS_WRONG;
}

static enum status put_file(const struct upload *upload, const struct upload_file *file)
{
	char path[1400];

	if (!upload_path(upload, file, path))
		return remote_fail(upload->remote, DESK_NONSENSE);
	make_folders(path, strlen(upload->folder) + 1);
	if (report_save(path, file->bytes, file->len) != STATUS_GOOD)
		return STATUS_WRONG;
	sink_text(&upload->remote->call->out, path);
	sink_text(&upload->remote->call->out, "\n");
	return STATUS_GOOD;
}

static enum status each_source(const struct upload *upload)
{
	const struct stored *stored = upload->stored;
	struct wire_reader in;
	const uint16_t count = stored_sources(stored, &in);
	enum status status = STATUS_GOOD;
	struct stored_source source;

	for (uint16_t i = 0; i < count && status == STATUS_GOOD; i++)
		status = stored_take_source(&in, &source) ?
			 upload->step(upload, &(struct upload_file){ source.name, source.name_len,
								    source.bytes, source.len }) :
			 remote_fail(upload->remote, DESK_NONSENSE);
	return status;
}

static enum status one_file(const struct upload *upload, const char *name, const void *bytes,
			    size_t len)
{
	return upload->step(upload, &(struct upload_file){ name, strlen(name), bytes, len });
}

static enum status each_file(const struct upload *upload)
{
	const struct stored *stored = upload->stored;
	enum status status = upload->list ?
		one_file(upload, "program.rung", upload->list, strlen(upload->list)) :
		each_source(upload);

	if (status == STATUS_GOOD)
		status = one_file(upload, "board.io", stored_part(stored, STORED_MAP),
				  stored->len[STORED_MAP]);
	if (status == STATUS_GOOD)
		status = one_file(upload, "program.rungc", stored_part(stored, STORED_IMAGE),
				  stored->len[STORED_IMAGE]);
	return status;
}

/* Writes nothing if one of the files is there already. */
static enum status write_upload(struct upload *upload)
{
	enum status status;

	upload->step = refuse_known;
	status = each_file(upload);
	if (status != STATUS_GOOD)
		return status;
	if (mkdir(upload->folder, 0777) != 0 && errno != EEXIST) {
		report_diag((struct diag){ .id = DIAG_NO_FOLDER, .file = upload->folder }, "%s",
			    strerror(errno));
		return STATUS_WRONG;
	}
	upload->step = put_file;
	return each_file(upload);
}

/* A board without sources: the program as lists made from its image. */
static enum status write_lists(struct upload *upload)
{
	const struct stored *stored = upload->stored;
	struct ladder *ladder = ladder_new();
	char *text = NULL, *lost = NULL;
	enum status status;
	size_t len = 0;

	if (!ladder)
		return report_no_memory(upload->remote->where);
	if (ladder_load_text(ladder, "program.rungc", stored_part(stored, STORED_IMAGE),
			     stored->len[STORED_IMAGE]))
		text = image_il_text(ladder_program(ladder), &len, &lost);
	else
		report_diags(ladder_diags(ladder));
	upload->list = text;
	status = text ? write_upload(upload) : STATUS_WRONG;
	if (status == STATUS_GOOD)
		fputs("the board stores no sources: program.rung is made from its code image\n",
		      stderr);
	if (lost)
		fputs(lost, stderr);
	free(text);
	free(lost);
	ladder_free(ladder);
	return status;
}

static bool has_sources(const struct stored *stored)
{
	struct wire_reader in;

	return stored_sources(stored, &in) > 0;
}

enum status remote_upload(struct remote *remote)
{
	struct stored stored = { .bytes = NULL };
	struct bytes bytes = { .at = NULL };
	struct upload upload = {
		.remote = remote, .folder = call_option(remote->call, "-o"), .stored = &stored,
	};
	enum status status;

	if (!upload.folder)
		return report_usage(remote->call, "upload needs -o FOLDER");
	status = remote_receive(remote, &stored, &bytes);
	if (status == STATUS_GOOD)
		status = has_sources(&stored) ? write_upload(&upload) : write_lists(&upload);
	free(bytes.at);
	return status;
}
