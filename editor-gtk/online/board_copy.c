/* SPDX-License-Identifier: MIT
 *
 * board_copy - see board_copy.h. The bytes are those of runtime/online/stored.h.
 */
#include "editor-gtk/online/board_copy.h"

#include "editor-gtk/document/plain_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/sim_program.h"

#include "engine/exchange/image/image_il.h"
#include "engine/ladder.h"
#include "engine/scan/code.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- what came ---- */

static GHashTable *new_table(void)
{
	return g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)g_bytes_unref);
}

/* A name that stays below the folder: no way up, no other root, no control character. */
static bool is_safe(const char *name, size_t len)
{
	if (!len || len > 200 || *name == '/' || *name == '.' || !g_utf8_validate(name, (gssize)len, NULL))
		return false;
	for (size_t i = 0; i < len; i++) {
		if ((unsigned char)name[i] < ' ' || name[i] == 127 || name[i] == '\\')
			return false;
		if (name[i] == '/' && (i + 1 == len || name[i + 1] == '/' || name[i + 1] == '.'))
			return false;
	}
	return true;
}

static bool read_sources(struct board_copy *copy, const struct stored *stored)
{
	struct wire_reader in;
	const uint16_t count = stored_sources(stored, &in);
	struct stored_source source;

	for (uint16_t i = 0; i < count; i++) {
		char *name;

		if (!stored_take_source(&in, &source) || !is_safe(source.name, source.name_len))
			return false;
		name = g_strndup(source.name, source.name_len);
		if (i == 0)
			copy->name = g_strdup(name);
		g_hash_table_insert(copy->files, name, g_bytes_new(source.bytes, source.len));
	}
	return wire_done(&in);
}

/* As load() of struct ladder_files. */
static char *load_file(void *context, const char *path, size_t *len)
{
	GBytes *bytes = g_hash_table_lookup(context, path);
	char *text;

	if (!bytes)
		return NULL;
	*len = g_bytes_get_size(bytes);
	text = malloc(*len + 1);
	if (!text)
		return NULL;
	memcpy(text, g_bytes_get_data(bytes, NULL), *len);
	text[*len] = '\0';
	return text;
}

static void free_table(void *context)
{
	g_hash_table_unref(context);
}

void board_copy_give_files(const struct board_copy *copy, struct ladder *reader)
{
	ladder_set_files(reader, &(struct ladder_files){ .load = load_file,
		.context = g_hash_table_ref(copy->files), .free = free_table });
}

/* The program as one text, if it is several files of plain IEC text without errors. */
static char *joined(const struct board_copy *copy)
{
	struct ladder *ladder = ladder_new();
	GPtrArray *names = g_ptr_array_new();
	const struct project *project;
	char *text = NULL;
	GHashTableIter at;
	gpointer name;
	gsize len;

	if (!ladder)
		g_error("out of memory");
	board_copy_give_files(copy, ladder);
	g_ptr_array_add(names, copy->name);
	g_hash_table_iter_init(&at, copy->files);
	while (g_hash_table_iter_next(&at, &name, NULL))
		if (strcmp(name, copy->name) != 0)
			g_ptr_array_add(names, name);
	ladder_load_stored(ladder, (const char *const *)names->pdata, (int)names->len);
	project = ladder_project(ladder);
	if (project && project->source_count > 1)
		text = plain_file_join(ladder, &len);
	g_ptr_array_unref(names);
	ladder_free(ladder);
	return text;
}

/* The first file is the program, or all of them are. */
static void part_sources(struct board_copy *copy)
{
	char *text = g_hash_table_size(copy->files) > 1 ? joined(copy) : NULL;
	GBytes *first;

	if (text) {
		copy->text = text;
		g_free(copy->name);
		copy->name = g_strdup("program");
		copy->parts = g_steal_pointer(&copy->files);
		copy->files = new_table();
	} else if (copy->name) {
		first = g_hash_table_lookup(copy->files, copy->name);
		copy->text = g_strndup(g_bytes_get_data(first, NULL), g_bytes_get_size(first));
		g_hash_table_remove(copy->files, copy->name);
	}
}

struct board_copy *board_copy_read(const struct stored *stored)
{
	struct board_copy *copy = g_new0(struct board_copy, 1);

	copy->files = new_table();
	copy->parts = new_table();
	copy->image = g_bytes_new(stored_part(stored, STORED_IMAGE), stored->len[STORED_IMAGE]);
	copy->map = g_strndup((const char *)stored_part(stored, STORED_MAP),
			      stored->len[STORED_MAP]);
	if (!read_sources(copy, stored)) {
		board_copy_free(copy);
		return NULL;
	}
	part_sources(copy);
	return copy;
}

void board_copy_free(struct board_copy *copy)
{
	if (!copy)
		return;
	g_clear_pointer(&copy->image, g_bytes_unref);
	g_clear_pointer(&copy->files, g_hash_table_unref);
	g_clear_pointer(&copy->parts, g_hash_table_unref);
	g_free(copy->map);
	g_free(copy->name);
	g_free(copy->text);
	g_free(copy);
}

/* ---- writing it ---- */

/* What one call has made, in order: files, and the folders that they needed. */
struct made { GPtrArray *files, *folders; };

/* All of it goes again; a folder in which somebody else has put something stays. */
static void undo_made(struct made *made)
{
	for (guint i = made->files->len; i-- > 0;)
		g_unlink(made->files->pdata[i]);
	for (guint i = made->folders->len; i-- > 0;)
		g_rmdir(made->folders->pdata[i]);
}

static int make_folder(struct made *made, const char *path)
{
	char *parent;
	int failed;

	if (g_file_test(path, G_FILE_TEST_IS_DIR))
		return 0;
	parent = g_path_get_dirname(path);
	failed = make_folder(made, parent);
	g_free(parent);
	if (!failed && g_mkdir(path, 0777) == 0)
		g_ptr_array_add(made->folders, g_strdup(path));
	else if (!failed)
		failed = errno;
	return failed;
}

/* 0 or errno. */
static int write_all(int fd, const char *bytes, gsize len)
{
	while (len) {
		const gssize put = write(fd, bytes, len);

		if (put < 0 && errno != EINTR)
			return errno;
		bytes += MAX(put, 0);
		len -= (gsize)MAX(put, 0);
	}
	return fsync(fd) == 0 ? 0 : errno;
}

static char *is_there(const char *path)
{
	return g_strdup_printf(_("“%s” is there already; nothing was written. Choose another folder."),
			       path);
}

/* Only if no file is there: nothing is ever replaced. NULL: good. Caller frees. */
static char *put_file(struct made *made, const char *folder, const char *name, const void *bytes,
		      gsize len)
{
	char *path = g_build_filename(folder, name, NULL), *parent = g_path_get_dirname(path);
	int failed = make_folder(made, parent), fd = -1;
	char *why = NULL;

	if (!failed) {
		fd = g_open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
		failed = fd < 0 ? errno : 0;
	}
	if (fd >= 0) {
		g_ptr_array_add(made->files, g_strdup(path));
		failed = write_all(fd, bytes, len);
		if (close(fd) != 0 && !failed)
			failed = errno;
	}
	if (failed == EEXIST)
		why = is_there(path);
	else if (failed)
		why = g_strdup_printf(_("“%s”: %s. Nothing was written."), path,
				      g_strerror(failed));
	g_free(parent);
	g_free(path);
	return why;
}

char *board_copy_make_lists(struct board_copy *copy)
{
	struct ladder *ladder = ladder_new();
	char *lost = NULL, *text = NULL, *said;
	gsize size, len = 0;
	const void *image = g_bytes_get_data(copy->image, &size);

	if (!ladder)
		g_error("out of memory");
	if (!copy->text && ladder_load_text(ladder, "", image, size) && ladder_program(ladder))
		text = image_il_text(ladder_program(ladder), &len, &lost);
	if (text) {
		copy->name = g_strdup("program.rung");
		copy->text = g_strndup(text, len);
	}
	said = g_strdup(lost);
	free(text);
	free(lost);
	ladder_free(ladder);
	return said;
}

static char *put_table(struct made *made, const char *folder, GHashTable *files)
{
	GHashTableIter at;
	gpointer name, bytes;
	char *why = NULL;

	g_hash_table_iter_init(&at, files);
	while (!why && g_hash_table_iter_next(&at, &name, &bytes))
		why = put_file(made, folder, name, g_bytes_get_data(bytes, NULL),
			       g_bytes_get_size(bytes));
	return why;
}

/* What else is in a folder would belong to its program, so it is a new one. */
static char *put_parts(struct made *made, const struct board_copy *copy, const char *folder)
{
	char *inner = g_build_filename(folder, copy->name, NULL), *why;

	why = g_file_test(inner, G_FILE_TEST_EXISTS) ? is_there(inner) :
	      put_table(made, inner, copy->parts);
	g_free(inner);
	return why;
}

char *board_copy_save(const struct board_copy *copy, const char *folder, const char *map)
{
	struct made made = { g_ptr_array_new_with_free_func(g_free),
			     g_ptr_array_new_with_free_func(g_free) };
	char *why = g_hash_table_size(copy->parts) ? put_parts(&made, copy, folder) :
		    put_file(&made, folder, copy->name, copy->text, strlen(copy->text));

	if (!why)
		why = put_table(&made, folder, copy->files);
	if (!why)
		why = put_file(&made, folder, map, copy->map, strlen(copy->map));
	if (why)
		undo_made(&made);
	g_ptr_array_unref(made.files);
	g_ptr_array_unref(made.folders);
	return why;
}

/* ---- files to send ---- */

static void add_u32(GByteArray *bytes, guint32 value)
{
	const guint32 wire = GUINT32_TO_LE(value);

	g_byte_array_append(bytes, (const guint8 *)&wire, sizeof(wire));
}

static void add_u16(GByteArray *bytes, guint16 value)
{
	const guint16 wire = GUINT16_TO_LE(value);

	g_byte_array_append(bytes, (const guint8 *)&wire, sizeof(wire));
}

static void add_file(GByteArray *bytes, const char *name, const void *text, gsize len)
{
	add_u16(bytes, (guint16)strlen(name));
	g_byte_array_append(bytes, (const guint8 *)name, (guint)strlen(name));
	add_u32(bytes, (guint32)len);
	if (len)
		g_byte_array_append(bytes, text, (guint)len);
}

/* As the file of the program names it: below its folder, else its own name only. */
static const char *source_name(const char *path, const char *program)
{
	const char *slash = strrchr(program, '/'), *own = strrchr(path, '/');
	const gsize folder = slash ? (gsize)(slash + 1 - program) : 0;

	if (strncmp(path, program, folder) == 0 && is_safe(path + folder, strlen(path + folder)))
		return path + folder;
	return own ? own + 1 : path;
}

/* A file that the program names, as the editor has it now. */
static bool add_used(GByteArray *bytes, struct ladder *ladder, const char *path,
		     const char *program, GError **error)
{
	const struct ladder_files files = ladder_files(ladder);
	size_t len = 0;
	char *text = files.load ? files.load(files.context, path, &len) : NULL;
	char *owned = NULL;
	gsize size = len;

	if (!text && !g_file_get_contents(path, &owned, &size, error))
		return false;
	add_file(bytes, source_name(path, program), text ? text : owned, size);
	free(text);
	g_free(owned);
	return true;
}

static bool add_sources(GByteArray *bytes, struct ladder *ladder, LadderDocument *document,
			const char *text, GError **error)
{
	const struct project *project = ladder_project(ladder);
	const char *path = ladder_document_path(document);
	char *name = path ? g_path_get_basename(path) :
			    g_strdup(project->source[0].plain ? "program.st" : "program.rung");
	bool good = true;

	add_u16(bytes, (guint16)(1 + project->used_count));
	add_file(bytes, name, text, strlen(text));
	for (int i = 0; i < project->used_count && good; i++)
		good = add_used(bytes, ladder, project->used[i], path ? path : "", error);
	g_free(name);
	return good;
}

static bool gather(struct board_program *program, struct sim_program *built,
		   LadderDocument *document, const char *map, GError **error)
{
	struct stored *stored = &program->stored;
	size_t image_len;
	const void *image = ladder_image(built->ladder, &image_len);

	g_byte_array_append(program->bytes, image, (guint)image_len);
	g_byte_array_append(program->bytes, (const guint8 *)map, (guint)strlen(map));
	if (!add_sources(program->bytes, built->ladder, document, built->text, error))
		return false;
	stored->len[STORED_IMAGE] = (uint32_t)image_len;
	stored->len[STORED_MAP] = (uint32_t)strlen(map);
	stored->len[STORED_SOURCES] = program->bytes->len - (uint32_t)(image_len + strlen(map));
	stored->bytes = program->bytes->data;
	code_identity(built->program, program->identity);
	if (stored_size(stored))
		return true;
	g_set_error(error, G_IO_ERROR, G_IO_ERROR_FAILED,
		    _("The program is larger than a board can take: %u MiB"), STORED_MOST >> 20);
	return false;
}

struct board_program *board_program_new(LadderDocument *document, const char *map, GError **error)
{
	const char *file = ladder_document_file(document);
	gsize len;
	char *text = ladder_document_text(document, &len);
	struct sim_program *built = sim_program_read(ladder_document_reader(document),
		g_intern_string(*file ? file : "-"), text, len, error);
	struct board_program *program = NULL;

	if (built) {
		program = g_atomic_rc_box_new0(struct board_program);
		program->bytes = g_byte_array_new();
		if (!gather(program, built, document, map, error))
			g_clear_pointer(&program, board_program_unref);
		sim_program_unref(built);
	}
	g_free(text);
	return program;
}

struct board_program *board_program_ref(struct board_program *program)
{
	return g_atomic_rc_box_acquire(program);
}

static void program_clear(gpointer data)
{
	struct board_program *program = data;

	g_byte_array_unref(program->bytes);
}

void board_program_unref(gpointer program)
{
	g_atomic_rc_box_release_full(program, program_clear);
}

/* ---- upload ---- */

struct upload {
	LadderBoardLink *link;
	gpointer owner;        /* weak                                         */
	bool owned;
	GByteArray *bytes;
	board_copied copied;
	gpointer data;
};

static void upload_free(struct upload *upload)
{
	g_byte_array_unref(upload->bytes);
	g_object_unref(upload->link);
	if (upload->owned && upload->owner)
		g_object_remove_weak_pointer(upload->owner, &upload->owner);
	g_free(upload);
}

static void upload_end(struct upload *upload, struct board_copy *copy, const char *why,
		       bool locked)
{
	if (upload->owner || !upload->owned)
		upload->copied(upload->data, copy, why, locked);
	else
		board_copy_free(copy);
	upload_free(upload);
}

static void ask_part(struct upload *upload);

static void part_came(gpointer data, struct board_answer *answer)
{
	struct upload *upload = data;
	struct stored stored;
	uint32_t size;
	size_t len;

	if (answer->end != DESK_GOOD) {
		upload_end(upload, NULL, answer->text, answer->end == DESK_REFUSED &&
			   answer->refusal == REFUSAL_PASSWORD);
		return;
	}
	for (int i = 0; i < STORED_PARTS; i++)
		stored.len[i] = wire_u32(&answer->body);
	size = stored_size(&stored);
	len = wire_left(&answer->body);
	if (!answer->body.failed && !stored.len[STORED_IMAGE]) {
		upload_end(upload, NULL, _("The board has no program."), false);
		return;
	}
	if (answer->body.failed || !size || len > size - MIN(size, upload->bytes->len) ||
	    (!len && upload->bytes->len < size)) {
		upload_end(upload, NULL, _("What the board sent is no program"), false);
		return;
	}
	if (len)
		g_byte_array_append(upload->bytes, answer->body.at, (guint)len);
	if (upload->bytes->len < size) {
		ask_part(upload);
		return;
	}
	stored.bytes = upload->bytes->data;
	struct board_copy *copy = board_copy_read(&stored);

	upload_end(upload, copy, copy ? NULL : _("What the board sent is no program"), false);
}

static void ask_part(struct upload *upload)
{
	struct wire_writer fields = ladder_board_link_begin(upload->link);

	wire_put_u32(&fields, upload->bytes->len);
	ladder_board_link_send(upload->link, SERVICE_UPLOAD, &fields, NULL, part_came, upload);
}

void board_upload(LadderBoardLink *link, gpointer owner, board_copied copied, gpointer data)
{
	struct upload *upload = g_new0(struct upload, 1);

	upload->link = g_object_ref(link);
	upload->owner = owner;
	upload->owned = owner != NULL;
	if (owner)
		g_object_add_weak_pointer(owner, &upload->owner);
	upload->bytes = g_byte_array_new();
	upload->copied = copied;
	upload->data = data;
	ask_part(upload);
}

void board_unlock(LadderBoardLink *link, const char *password, gpointer owner,
		  board_answered answered, gpointer data)
{
	struct wire_writer fields = ladder_board_link_begin(link);

	wire_put_u8(&fields, 0);
	wire_put_string(&fields, password);
	ladder_board_link_send(link, SERVICE_PASSWORD, &fields, owner, answered, data);
}
