/* SPDX-License-Identifier: MIT
 *
 * ladder - the facade: reads, checks, translates and verifies a program, in this order.
 *
 * It owns its results and prints nothing.
 */
#include "engine/ladder.h"

#include "engine/base/file.h"
#include "engine/check/check.h"
#include "engine/check/check_il.h"
#include "engine/check/check_tokens.h"
#include "engine/check/expect.h"
#include "engine/check/generic.h"
#include "engine/check/settle.h"
#include "engine/check/values.h"
#include "engine/check/wires.h"
#include "engine/model/caller.h"
#include "engine/model/located.h"
#include "engine/scan/symbol_index.h"
#include "engine/text/mend.h"
#include "engine/text/text.h"
#include "engine/translate/located_calls.h"
#include "engine/translate/translate.h"
#include "engine/exchange/classic/sfc_ladder.h"
#include "engine/exchange/iec_file/iec_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct ladder {
	const struct advice *advice; /* for every project; NULL: none          */
	struct diag_list diags;
	struct project *project;
	struct arena arena;       /* of the translation                     */
	struct arena scratch;
	struct translation translation;
	void *loaded;             /* a code image as it was read            */
	const void *image;
	size_t image_len;
	struct program program;
	bool good, built, unreadable, watch, lists; /* good: the last load succeeded */
	bool leaves;              /* constant expressions are not computed  */
	struct foreign *foreign;  /* NULL: rung files and images alone      */
	struct ladder_files files; /* load NULL: the disk                    */
};

struct ladder *ladder_new(void)
{
	static const struct advice desk = { mend_line, expect_nearest, iec_file_text, check_tokens };
	struct ladder *ladder = ladder_new_terse();

	if (ladder)
		ladder->advice = &desk;
	return ladder;
}

struct ladder *ladder_new_terse(void)
{
	struct ladder *ladder = calloc(1, sizeof(*ladder));

	if (ladder) {
		arena_init(&ladder->arena);
		arena_init(&ladder->scratch);
		diag_init(&ladder->diags);
	}
	return ladder;
}

static void unload(struct ladder *ladder)
{
	project_free(ladder->project);
	ladder->project = NULL;
	arena_free(&ladder->arena);
	arena_free(&ladder->scratch);
	free(ladder->loaded);
	ladder->loaded = NULL;
	ladder->image = NULL;
	ladder->image_len = 0;
	for (struct foreign *each = ladder->foreign; each; each = each->next) {
		each->forget(each);
		each->loaded = false;
	}
	ladder->good = ladder->built = false;
	memset(&ladder->translation, 0, sizeof(ladder->translation));
	memset(&ladder->program, 0, sizeof(ladder->program));
}

static void free_foreign(struct ladder *ladder)
{
	struct foreign *next;

	for (struct foreign *each = ladder->foreign; each; each = next) {
		next = each->next;
		each->free(each);
	}
	ladder->foreign = NULL;
}

void ladder_free(struct ladder *ladder)
{
	if (!ladder)
		return;
	unload(ladder);
	free_foreign(ladder);
	ladder_set_files(ladder, NULL);
	free(ladder);
}

void ladder_add_foreign(struct ladder *ladder, struct foreign *foreign)
{
	foreign->next = ladder->foreign;
	ladder->foreign = foreign;
}

struct foreign *ladder_foreign(const struct ladder *ladder)
{
	return ladder->foreign;
}

static struct foreign *loaded_foreign(const struct ladder *ladder)
{
	struct foreign *each = ladder->foreign;

	while (each && !each->loaded)
		each = each->next;
	return each;
}

static bool no_memory(struct ladder *ladder, const char *file)
{
	struct diag place = { .id = DIAG_NO_MEMORY, .file = file };

	for (int i = 0; i < ladder->diags.count; i++)
		if (ladder->diags.diag[i].id == DIAG_NO_MEMORY)
			return false;
	return diag_add(&ladder->diags, place, "%s", "");
}

/* ---- loading ---- */

void ladder_set_files(struct ladder *ladder, const struct ladder_files *files)
{
	if (ladder->files.free)
		ladder->files.free(ladder->files.context);
	ladder->files = files ? *files : (struct ladder_files){ .load = NULL };
}

struct ladder_files ladder_files(const struct ladder *ladder)
{
	struct ladder_files files = ladder->files;

	files.free = NULL;
	return files;
}

static char *load_named(const struct ladder *ladder, const char *path, size_t *len)
{
	const struct ladder_files *files = &ladder->files;
	char *text = files->load ? files->load(files->context, path, len) : NULL;

	errno = 0;
	if (!text && (!files->load || files->or_disk))
		return file_read(path, LIMIT_TEXT, len, NULL);
	errno = text ? 0 : ENOENT;
	return text;
}

/* Reads a file that is named relative to another one. */
static char *load_include(void *context, const char *from, const char *name,
			  size_t *len, struct diag_list *diags,
			  struct diag place)
{
	const char *slash = strrchr(from, '/');
	size_t folder = slash ? (size_t)(slash - from) + 1 : 0;
	size_t size = folder + strlen(name) + 1;
	char *path, *text;
	int before = diags->errors;

	if (name[0] == '/')
		folder = 0;
	path = malloc(size);
	if (!path) {
		place.id = DIAG_NO_MEMORY;
		diag_add(diags, place, "%s", "");
		return NULL;
	}
	memcpy(path, from, folder);
	memcpy(path + folder, name, strlen(name) + 1);
	text = load_named(context, path, len);
	if (!text && diags->errors == before) {
		place.id = DIAG_BAD_INCLUDE;
		diag_add(diags, place, "%.30s" DIAG_AND "%s", name,
			 errno ? strerror(errno) : "not a file of text");
	}
	free(path);
	return text;
}

static bool is_image(const void *bytes, size_t len)
{
	size_t magic = strlen(CODE_MAGIC);

	return len >= magic && memcmp(bytes, CODE_MAGIC, magic) == 0;
}

static bool open_image(struct ladder *ladder, const char *file,
		       const void *bytes, size_t len, bool made)
{
	struct diag place = { .id = DIAG_IMAGE_DAMAGED, .file = file };
	size_t where;

	if (made && len <= LIMIT_IMAGE ?
		   code_open_made(bytes, &ladder->scratch, &ladder->program, &place.id, &where) :
		   code_open(bytes, len, &ladder->scratch, &ladder->program, &place.id, &where)) {
		ladder->image = bytes;
		ladder->image_len = len;
		ladder->program.index = symbol_index_new(&ladder->program, &ladder->arena);
		return true;
	}
	memset(&ladder->program, 0, sizeof(ladder->program));
	if (place.id == DIAG_NO_MEMORY)
		return no_memory(ladder, file);
	return diag_add(&ladder->diags, place, "byte %zu", where);
}

/* Reads text into a new project. */
static bool read_project(struct ladder *ladder, const struct text_file *files, int count)
{
	struct text_source source = { .load = load_include, .context = ladder };
	bool good;

	ladder->project = project_new(files->name);
	if (!ladder->project)
		return no_memory(ladder, files->name);
	ladder->project->advice = ladder->advice;
	good = text_read_files(ladder->project, files, count, &source, &ladder->diags);
	if (ladder->project->arena.failed)
		good = no_memory(ladder, files->name);
	arena_reset(&ladder->scratch);
	return good && (ladder->leaves ||
			(settle_project(ladder->project, &ladder->scratch, &ladder->diags) &&
			 wires_make(ladder->project, &ladder->scratch, &ladder->diags) &&
			 located_place(ladder->project, &ladder->diags)));
}

/* The same with what a desk makes of @disk; @files is a copy; @made gets the texts, which the caller frees. */
static bool read_made(struct ladder *ladder, const struct text_file *disk, struct text_file *files,
		      int count, char **made)
{
	bool good = true;

	for (int i = 0; i < count && ladder->advice; i++) {
		size_t len = 0;

		good &= ladder->advice->text(disk, count, i, &made[i], &len, &ladder->diags);
		if (made[i])
			files[i] = (struct text_file){ files[i].name, made[i], len, true };
	}
	return good && read_project(ladder, files, count);
}

static bool read_texts(struct ladder *ladder, const struct text_file *files, int count)
{
	char **made = calloc((size_t)count, sizeof(*made));
	struct text_file *read = calloc((size_t)count, sizeof(*read));
	bool good;

	if (made && read) {
		memcpy(read, files, (size_t)count * sizeof(*read));
		good = read_made(ladder, files, read, count, made);
	} else {
		good = no_memory(ladder, files->name);
	}
	for (int i = 0; made && i < count; i++)
		free(made[i]);
	free(made);
	free(read);
	return good;
}

/* The reader of a file, or of the folder @file if @bytes is NULL; NULL: none. */
static struct foreign *find_foreign(const struct ladder *ladder, const char *file,
				    const void *bytes, size_t len)
{
	struct foreign *each = ladder->foreign;

	while (each && !(bytes ? each->is(bytes, len) : each->is_folder && each->is_folder(file)))
		each = each->next;
	return each;
}

static bool load_bytes(struct ladder *ladder, const char *file,
		       const void *bytes, size_t len)
{
	struct foreign *foreign;

	if (bytes && is_image(bytes, len)) {
		ladder->loaded = malloc(len);
		if (!ladder->loaded)
			return no_memory(ladder, file);
		memcpy(ladder->loaded, bytes, len);
		return open_image(ladder, file, ladder->loaded, len, false);
	}
	foreign = find_foreign(ladder, file, bytes, len);
	if (foreign) {
		bytes = foreign->read(foreign, file, bytes, len, &len, &file, &ladder->diags);
		foreign->loaded = bytes != NULL;
		if (!bytes)
			return false;
		foreign->text = bytes;
		foreign->text_len = len;
	}
	return read_texts(ladder, &(struct text_file){ file, bytes, len, false }, 1);
}

static void place_foreign(struct ladder *ladder)
{
	for (struct foreign *each = ladder->foreign; each; each = each->next)
		each->place(each, &ladder->diags);
}

/* Diagnostics point to names in the project, so a project with errors is kept until the
 * next load, but ladder_project() does not return it. */
bool ladder_load_text(struct ladder *ladder, const char *file, const void *text,
		      size_t len)
{
	unload(ladder);
	diag_init(&ladder->diags);
	ladder->unreadable = false;
	ladder->good = load_bytes(ladder, file, text, len) &&
		       ladder->diags.errors == 0;
	place_foreign(ladder);
	return ladder->good;
}

bool ladder_load(struct ladder *ladder, const char *path)
{
	size_t len;
	char *bytes;

	bool folder;

	unload(ladder);
	diag_init(&ladder->diags);
	bytes = file_read(path, LIMIT_TEXT, &len, &ladder->diags);
	folder = !bytes && find_foreign(ladder, path, NULL, 0);
	ladder->unreadable = !bytes && !folder;
	if (ladder->unreadable)
		return false;
	if (folder)
		diag_init(&ladder->diags);
	ladder->good = load_bytes(ladder, path, bytes, bytes ? len : 0) &&
		       ladder->diags.errors == 0;
	place_foreign(ladder);
	free(bytes);
	return ladder->good;
}

/* All that can be read; the others have their message. */
static int read_named(struct ladder *ladder, const char *const *paths, int count,
		      struct text_file *files)
{
	int read = 0;

	for (int i = 0; i < count; i++) {
		const char *name = arena_copy(&ladder->arena, paths[i], strlen(paths[i]));

		if (!name)
			return no_memory(ladder, "") ? 0 : read;
		files[read].name = name;
		files[read].text = ladder->files.load ? load_named(ladder, name, &files[read].len) :
				   file_read(name, LIMIT_TEXT, &files[read].len, &ladder->diags);
		read += files[read].text != NULL;
	}
	return read;
}

bool ladder_load_files(struct ladder *ladder, const char *const *paths, int count)
{
	struct text_file *files;
	int read;

	if (count == 1)
		return ladder_load(ladder, paths[0]);
	unload(ladder);
	diag_init(&ladder->diags);
	ladder->unreadable = !count;
	if (!count)
		return diag_add(&ladder->diags, (struct diag){ .id = DIAG_EMPTY_FOLDER,
							       .file = paths[0] }, "%s", "");
	files = calloc((size_t)count, sizeof(*files));
	if (!files)
		return no_memory(ladder, paths[0]);
	read = read_named(ladder, paths, count, files);
	ladder->unreadable = read < count;
	ladder->good = read == count && read_texts(ladder, files, count) &&
		       ladder->diags.errors == 0;
	while (read > 0)
		free((void *)files[--read].text);
	free(files);
	return ladder->good;
}

bool ladder_load_stored(struct ladder *ladder, const char *const *names, int count)
{
	size_t len = 0;
	char *text = load_named(ladder, names[0], &len);
	const struct project *project;

	ladder_load_text(ladder, names[0], text ? text : "", len);
	free(text);
	project = ladder->project;
	return count > 1 && project && project->source[0].plain ?
	       ladder_load_files(ladder, names, count) : ladder->good;
}

void ladder_leave_expressions(struct ladder *ladder, bool leave)
{
	ladder->leaves = leave;
}

void ladder_watch(struct ladder *ladder, bool watch)
{
	ladder->watch = watch;
}

void ladder_watch_lists(struct ladder *ladder, bool lists)
{
	ladder->lists = lists;
}

bool ladder_could_read(const struct ladder *ladder)
{
	return !ladder->unreadable;
}

/* ---- building ---- */

/* Topology; a rung with errors gets a 1 and is not translated. */
static bool check_pou(struct ladder *ladder, const struct pou *pou, uint8_t *bad)
{
	struct network network;

	for (int i = 0; i < pou->rung_count; i++) {
		if (pou->rung[i]->off)
			continue;
		arena_reset(&ladder->scratch);
		if (!network_make(pou->rung[i], &ladder->scratch, &network))
			return no_memory(ladder, pou->file);
		if (!check_rung(ladder->project, pou, i + 1, pou->rung[i],
				&network, &ladder->scratch, &ladder->diags))
			bad[i] = 1;
		if (ladder->scratch.failed)
			return no_memory(ladder, pou->file);
	}
	return true;
}

/* Warnings about states that charts can reach, if there are no errors. */
static void check_states(struct ladder *ladder)
{
	struct project *project = ladder->project;

	if (!project->advice)
		return;
	for (int i = 0; i < project->pou_count && !ladder->diags.errors; i++) {
		if (!project->pou[i].sfc)
			continue;
		arena_reset(&ladder->scratch);
		project->advice->tokens(ladder->translation.scope, &project->pou[i],
			     &ladder->scratch, &ladder->diags);
	}
}

/* A byte a rung, by POU: 1: it has errors. NULL: no memory. */
static uint8_t **check_all(struct ladder *ladder)
{
	struct project *project = ladder->project;
	size_t count = (size_t)project->pou_count + 1;
	uint8_t **bad = arena_alloc(&ladder->arena, count * sizeof(*bad));

	for (int i = 0; bad && i < project->pou_count; i++) {
		bad[i] = arena_alloc(&ladder->arena,
				     (size_t)project->pou[i].rung_count + 1);
		if (!bad[i] || !check_pou(ladder, &project->pou[i], bad[i]))
			return NULL;
	}
	arena_reset(&ladder->scratch);
	if (bad)
		check_names(ladder->translation.scope, bad, &ladder->scratch,
			    &ladder->diags);
	if (bad && !ladder->scratch.failed)
		check_states(ladder);
	return ladder->scratch.failed || project->arena.failed ? NULL : bad;
}

/* The list of a POU, plain or instrumented, and its types. */
static bool make_list(struct ladder *ladder, struct unit *unit, bool watch,
		      const uint8_t *bad)
{
	struct translation *t = &ladder->translation;
	struct il *il = watch ? &unit->watch : &unit->il;
	enum iec_type **types = watch ? &unit->watch_types : &unit->types;

	if (pou_has_any_bounds(unit->pou)) {
		il->arena = &ladder->arena;
	} else if (unit->pou->language == LANGUAGE_IL) {
		if (!il_to_il(t, unit, &ladder->scratch))
			return no_memory(ladder, unit->pou->file);
		il_order_args(t->scope, unit->pou, il);
	} else if (unit->pou->language == LANGUAGE_SFC) {
		if (!bad[unit->pou->rung_count] &&
		    !sfc_to_il(t, unit, bad, watch, &ladder->scratch))
			return no_memory(ladder, unit->pou->file);
		il_order_args(t->scope, unit->pou, il);
	} else if (unit->pou->language == LANGUAGE_ST || unit->pou->language == LANGUAGE_FBD) {
		if (!bad[unit->pou->rung_count] && !st_to_il(t, unit, &ladder->scratch))
			return no_memory(ladder, unit->pou->file);
		il_order_args(t->scope, unit->pou, il);
	} else if (!ld_to_il(t, unit, bad, watch, &ladder->scratch)) {
		return no_memory(ladder, unit->pou->file);
	}
	if (!generic_lines(t->scope, unit->pou, il, &ladder->scratch) || !located_calls(t, unit, il) ||
	    !config_blocks(t, unit, il))
		return no_memory(ladder, unit->pou->file);
	values_in_list(t->scope, unit->pou, il);
	*types = arena_alloc(&ladder->arena,
			     ((size_t)il->count + 1) * sizeof(**types));
	if (!*types)
		return no_memory(ladder, unit->pou->file);
	arena_reset(&ladder->scratch);
	check_il(t->scope, unit->pou, il, &ladder->scratch, *types,
		 &ladder->diags);
	if (ladder->scratch.failed || ladder->project->arena.failed)
		return no_memory(ladder, unit->pou->file);
	return true;
}

static bool make_units(struct ladder *ladder, uint8_t *const *bad)
{
	struct translation *t = &ladder->translation;

	for (int i = 0; i < t->unit_count; i++) {
		struct unit *unit = &t->unit[i];

		unit->pou = &ladder->project->pou[i];
		if (!make_list(ladder, unit, false, bad[i]))
			return false;
		if (ladder->watch && ladder->diags.errors == 0 &&
		    unit->pou->language != LANGUAGE_IL && unit->pou->language != LANGUAGE_ST &&
		    unit->pou->language != LANGUAGE_FBD &&
		    !make_list(ladder, unit, true, bad[i]))
			return false;
	}
	return true;
}

static bool check_lists(struct ladder *ladder)
{
	struct translation *t = &ladder->translation;
	struct il_pou *list = arena_alloc(&ladder->arena,
		((size_t)t->unit_count + 1) * sizeof(*list));

	for (int i = 0; list && i < t->unit_count; i++)
		list[i] = (struct il_pou){ t->unit[i].pou, &t->unit[i].il };
	arena_reset(&ladder->scratch);
	if (!list)
		return false;
	check_calls(t->scope, list, t->unit_count, &ladder->scratch,
		    &ladder->diags);
	return !ladder->scratch.failed &&
	       check_pins(t->scope, list, t->unit_count, &ladder->scratch,
			  &ladder->diags);
}

static bool begin_translation(struct ladder *ladder)
{
	struct translation *t = &ladder->translation;

	t->project = ladder->project;
	t->arena = &ladder->arena;
	t->diags = &ladder->diags;
	t->scope = scope_new(ladder->project, &ladder->arena);
	t->unit_count = ladder->project->pou_count;
	t->listing = ladder->lists;
	t->unit = arena_alloc(&ladder->arena, ((size_t)t->unit_count + 1) *
			      sizeof(*t->unit));
	return t->scope && t->unit;
}

/* ---- further instances of programs ---- */

/* Is POU @pou an action of the program that @entry is an instance of? */
static bool is_action_of(const struct project *project, int pou, const struct config_entry *entry)
{
	const char *of = project_text(project, entry->pou);

	return project->pou[pou].kind == POU_ACTION &&
	       pou_owner(project, &project->pou[pou]) == project_find_pou(project, of, strlen(of));
}

static int count_further(struct project *project)
{
	int count = 0;

	for (int i = 0; project->config && i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];

		count += entry->calls;
		if (!project_is_further(project, entry))
			continue;
		count++;
		for (int k = 0; k < project->pou_count; k++)
			count += is_action_of(project, k, entry);
	}
	return count;
}

/* The programs that call blocks with a task of their own: `Main.Pump();`. Fails: false: no memory. */
__attribute__((noinline)) /* its text is not on the stack of add_further() */
static bool add_callers(struct project *project, struct pou *pou, int *at)
{
	for (int i = 0; i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];

		for (int k = 0; k < entry->calls; k++) {
			struct st_item *item = arena_alloc(&project->arena, sizeof(*item));
			struct st *st = arena_alloc(&project->arena, sizeof(*st));
			const uint32_t name = project_called(project, entry, k);
			char text[2 * LIMIT_NAME + 8];
			const int len = snprintf(text, sizeof(text), "%s", project_text(project, name));

			if (!item || !st || !name)
				return false;
			*item = (struct st_item){ .kind = ST_CALL, .line = entry->line, .column = 1,
						  .text = names_intern(&project->names, text, (size_t)len) };
			*st = (struct st){ item, 1 };
			pou[*at] = (struct pou){ .name = name, .kind = POU_PROGRAM, .language = LANGUAGE_ST,
						 .word = WORD_COUNT, .temp_word = WORD_COUNT, .st = st,
						 .file = project->config->file, .line = entry->line,
						 .il.arena = &project->arena };
			++*at;
		}
	}
	return true;
}

/* Each becomes a program of its own behind the others: with the same rungs, and the name of
 * the instance. The vector stays as long as the translation refers to it; project->pou_count
 * counts them only meanwhile. Fails: false: no memory. */
static bool add_further(struct project *project, int count)
{
	const struct config *config = project->config;
	int at = project->pou_count, room = 8;
	char name[2 * LIMIT_NAME + 2];
	struct pou *pou;

	while (room < at + count)
		room *= 2;
	pou = arena_alloc(&project->arena, 2 * (size_t)room * sizeof(*pou));
	if (!pou)
		return false;
	memcpy(pou, project->pou, (size_t)at * sizeof(*pou));
	for (int i = 0; i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		const char *of = project_text(project, entry->pou);

		if (!project_is_further(project, entry))
			continue;
		pou[at] = pou[project_find_pou(project, of, strlen(of))];
		pou[at].name = entry->name;
		if (!located_further(project, &pou[at++]))
			return false;
		for (int k = 0; k < project->pou_count; k++) {
			if (!is_action_of(project, k, entry))
				continue;
			snprintf(name, sizeof(name), "%s.%s", project_text(project, entry->name),
				 pou_own_name(project, &pou[k]));
			pou[at] = pou[k];
			pou[at++].name = names_intern(&project->names, name, strlen(name));
		}
	}
	if (!add_callers(project, pou, &at))
		return false;
	project->pou = pou;
	project->pou_count = at;
	return true;
}

/* Translates all of it once more, with the further instances. It was checked, so what is said
 * this time was said before. */
static bool translate_further(struct ladder *ladder, int count)
{
	struct project *project = ladder->project;
	struct diag_list *diags = &ladder->diags;
	const int kept = diags->count, dropped = diags->dropped;
	uint8_t **bad = arena_alloc(&ladder->arena, ((size_t)project->pou_count + (size_t)count) *
							    sizeof(*bad));
	bool good = bad && add_further(project, count);

	for (int i = 0; good && i < project->pou_count; i++) {
		bad[i] = arena_alloc(&ladder->arena, (size_t)project->pou[i].rung_count + 1);
		good = bad[i] != NULL;
	}
	good = good && begin_translation(ladder) && make_units(ladder, bad);
	if (diags->errors)
		return false;
	diags->count = kept;
	diags->dropped = dropped;
	return good || no_memory(ladder, project->file);
}

static bool make_image(struct ladder *ladder)
{
	struct project *project = ladder->project;

	ladder->image = assemble(&ladder->translation, ladder->watch,
				 &ladder->image_len);
	if (!ladder->image)
		return ladder->diags.errors ? false :
		       no_memory(ladder, project->file);
	arena_reset(&ladder->scratch);
	return open_image(ladder, project->file, ladder->image,
			  ladder->image_len, true);
}

static bool build(struct ladder *ladder)
{
	struct project *project = ladder->project;
	uint8_t **bad;
	bool good;
	int further;

	if (!project || ladder->built || ladder->diags.errors || ladder->leaves)
		return ladder->program.header && ladder->diags.errors == 0;
	ladder->built = true;
	if (!generic_add(project, &ladder->arena, &ladder->diags))
		return ladder->diags.errors ? false : no_memory(ladder, project->file);
	if (!begin_translation(ladder))
		return no_memory(ladder, project->file);
	bad = check_all(ladder);
	if (!bad)
		return no_memory(ladder, project->file);
	if (!make_units(ladder, bad) || ladder->diags.errors)
		return false;
	if (!check_lists(ladder))
		return no_memory(ladder, project->file);
	if (ladder->diags.errors)
		return false;
	further = count_further(project);
	good = (!further || translate_further(ladder, further)) && make_image(ladder);
	return good;
}

/* Several copies of a function have the same mistakes: reports each once. */
static void say_once(const struct project *project, struct diag_list *diags)
{
	bool copies = false;
	int kept = 0;

	for (int i = 0; i < project->pou_count; i++)
		copies |= project->pou[i].copy_of > 0;
	for (int i = 0; copies && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		bool again = false;

		for (int k = 0; k < kept && !again; k++)
			again = diags->diag[k].id == diag->id && diags->diag[k].line == diag->line &&
				diags->diag[k].column == diag->column && diags->diag[k].rung == diag->rung &&
				diags->diag[k].row == diag->row && diags->diag[k].col == diag->col &&
				diags->diag[k].file == diag->file && strcmp(diags->diag[k].arg, diag->arg) == 0;
		diags->errors -= again && diag_severity(diag->id) == SEVERITY_ERROR;
		if (!again)
			diags->diag[kept++] = *diag;
	}
	diags->count = copies ? kept : diags->count;
}

bool ladder_build(struct ladder *ladder)
{
	struct project *project = ladder->project;
	const int pous = project ? project->pou_count : 0;
	bool good = !project || ladder->built || caller_add(project) ||
		    no_memory(ladder, project->file);

	good = good && build(ladder);
	if (project) {
		say_once(project, &ladder->diags);
		generic_end(project, pous);
		project->pou_count = pous;
	}

	place_foreign(ladder);
	ladder->program.classic = loaded_foreign(ladder) && loaded_foreign(ladder)->classic;
	return good;
}

/* ---- results ---- */

struct diag_list *ladder_diags(struct ladder *ladder)
{
	return &ladder->diags;
}

struct project *ladder_project(struct ladder *ladder)
{
	return ladder->good ? ladder->project : NULL;
}

struct project *ladder_read_project(struct ladder *ladder)
{
	return ladder->project;
}

const struct program *ladder_program(const struct ladder *ladder)
{
	return ladder->program.header ? &ladder->program : NULL;
}

const void *ladder_image(const struct ladder *ladder, size_t *len)
{
	*len = ladder->image_len;
	return ladder->image;
}

const struct il *ladder_il(const struct ladder *ladder, int pou)
{
	if (!ladder->translation.unit || pou < 0 ||
	    pou >= ladder->translation.unit_count)
		return NULL;
	return &ladder->translation.unit[pou].il;
}

struct var *const *ladder_temporaries(const struct ladder *ladder, int pou,
				      int *count)
{
	const struct unit *unit;

	*count = 0;
	if (!ladder->translation.unit || pou < 0 ||
	    pou >= ladder->translation.unit_count)
		return NULL;
	unit = &ladder->translation.unit[pou];
	*count = unit->temp_count;
	return unit->temp;
}

size_t ladder_memory(const struct ladder *ladder)
{
	size_t project = ladder->project ? ladder->project->arena.reserved : 0;

	return project + ladder->arena.reserved + ladder->scratch.reserved;
}

char *ladder_write(struct ladder *ladder, size_t *len)
{
	return ladder->good && ladder->project ?
	       text_write(ladder->project, len) : NULL;
}

char *ladder_write_source(struct ladder *ladder, int number, size_t *len)
{
	return ladder->good && ladder->project ?
	       text_write_source(ladder->project, number, len) : NULL;
}

struct rung *ladder_read_rung(struct ladder *ladder, const char *text, size_t len,
			      struct diag_list *diags)
{
	return ladder_project(ladder) ?
	       text_read_rung(ladder->project, text, len, diags) : NULL;
}

bool ladder_take_boxes(struct ladder *ladder, int pou)
{
	struct project *project = ladder_project(ladder);

	return project && text_take_boxes(project, &project->pou[pou]);
}

bool ladder_read_var(struct ladder *ladder, int pou, int block, const char *text,
		     size_t len, struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	struct pou *of = project && pou >= 0 ? &project->pou[pou] : NULL;
	struct var_table *table;
	int last;

	if (!project || !text_read_var(project, of, block, text, len, diags))
		return false;
	table = of ? &of->vars : &project->globals;
	last = table->block[block].first + table->block[block].count - 1;
	arena_reset(&ladder->scratch);
	if (settle_var(project, pou + 1, last, &ladder->scratch, diags))
		return true;
	vars_pop(table, block);
	return false;
}

bool ladder_constant(struct ladder *ladder, int table, const char *text, size_t len,
		     struct init_value *out, struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);

	arena_reset(&ladder->scratch);
	return project && settle_value(project, table, text, len, out, &ladder->scratch, diags);
}

char *ladder_write_rung(struct ladder *ladder, const struct rung *rung)
{
	return ladder_project(ladder) ?
	       text_write_rung(ladder->project, rung) : NULL;
}

char *ladder_export_ladder(struct ladder *ladder, size_t *len, struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	struct sink_memory memory;
	struct sink sink;
	bool good;

	if (!project)
		return NULL;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	good = sfc_ladder(project, NULL, &sink, diags);
	if (good && !memory.failed) {
		*len = memory.len;
		return memory.text;
	}
	if (memory.failed)
		no_memory(ladder, project->file);
	sink_memory_free(&memory);
	return NULL;
}

char *ladder_outline(struct ladder *ladder, size_t *len,
		     void (*take)(void *context, const struct text_span *span),
		     void *context)
{
	return ladder_project(ladder) ?
	       text_outline(ladder->project, len, take, context) : NULL;
}
