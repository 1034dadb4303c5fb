/* SPDX-License-Identifier: MIT
 *
 * read_project - a rung file from its first line to its last: parts, includes, and the
 * frames of POUs.
 *
 * It opens no file: the caller supplies what INCLUDE names.
 */
#include "engine/model/named.h"
#include "engine/model/shape.h"
#include "engine/text/reader.h"

#include "engine/base/ascii.h"

#include <stdlib.h>
#include <string.h>

/* ---- the first lines ---- */

static bool is_number(const struct token *token)
{
	for (size_t i = 0; i < token->len; i++)
		if (!ascii_digit(token->text[i]))
			return false;
	return token->kind == TOKEN_NUMBER;
}

static bool read_first_line(struct reader *r)
{
	reader_skip_newlines(r);
	reader_next(r);
	if (!is_number(&r->lex.token) || r->lex.token.text[0] == '0')
		return reader_fail_word(r, DIAG_NOT_RUNGBOARD, "");
	if (!lex_is(&r->lex, "1"))
		return reader_fail_token(r, DIAG_NEWER_VERSION);
	reader_next(r);
	reader_end_line(r);
	return true;
}

/* The string behind PROJECT or the word of a property. */
static void read_quoted(struct reader *r, const char *what, uint32_t *out)
{
	uint32_t text = 0;

	reader_next(r);
	if (r->lex.token.kind != TOKEN_STRING) {
		reader_fail_word(r, DIAG_EXPECTED, what);
		reader_skip_line(r);
		return;
	}
	if (reader_string(r, &text))
		reader_next(r);
	reader_end_line(r);
	if (r->outer || text == 0)
		return;
	if (!project_has_head(r->project))
		r->project->head = buffer_take(r, &r->above);
	*out = text;
}

/* PROJECT and the properties, in this order or another. A file that is included has its own. */
static void read_head(struct reader *r)
{
	bool seen[PROPERTY_COUNT + 1] = { false }; /* the last: PROJECT */
	uint32_t unused;

	for (;;) {
		enum property at;
		uint32_t *out;

		reader_skip_newlines(r);
		at = reader_property(r);
		if (at == PROPERTY_COUNT && !lex_is(&r->lex, "PROJECT"))
			return;
		out = at == PROPERTY_COUNT ? &r->project->title : &r->project->property[at];
		if (seen[at])
			reader_fail_token(r, DIAG_DUPLICATE_ARG);
		out = seen[at] ? &unused : out;
		/* Two calls: the translators' template takes one text of a call. */
		if (at == PROPERTY_COUNT)
			read_quoted(r, "title in \"…\"", out);
		else
			read_quoted(r, "text in \"…\"", out);
		seen[at] = true;
	}
}

/* ---- parts ---- */

/* Text between VIEW and END_VIEW belongs to the editor and is kept unchanged. */
static void read_view(struct reader *r)
{
	const struct token view = r->lex.token;
	struct part part = { .kind = PART_VIEW };
	const char *end = reader_view_end(&r->lex);

	if (!end) {
		reader_fail_open(r, &view);
		r->lex.at = r->lex.end;
	} else {
		r->lex.at = end;
		part.text = reader_intern(r, view.text,
					  (size_t)(end - view.text));
	}
	part.comment = buffer_take(r, &r->above);
	reader_add_part(r, part);
	reader_next(r);
	reader_end_line(r);
}

static void read_global_vars(struct reader *r)
{
	struct part part = { .kind = PART_VARS,
			     .index = r->project->globals.block_count };

	read_vars(r, &r->project->globals, true);
	if (r->project->globals.block_count > part.index)
		reader_add_part(r, part);
}

static void read_global_access(struct reader *r)
{
	struct part part = { .kind = PART_ACCESS, .index = read_access(r) };

	if (part.index >= 0)
		reader_add_part(r, part);
}

/* ---- INCLUDE ---- */

static void read_file(struct reader *r, const char *text, size_t len);

/* Why a file may not be included here; DIAG_COUNT: it may. */
static enum diag_id include_fault(const struct reader *r, const char *path)
{
	int depth = 0;

	for (; r; r = r->outer) {
		if (!strcmp(r->place.file, path))
			return DIAG_INCLUDE_CIRCLE;
		if (++depth > LIMIT_INCLUDES)
			return DIAG_INCLUDE_DEEP;
	}
	return DIAG_COUNT;
}

static void read_included(struct reader *r, const char *path, bool library,
			  const char *text, size_t len)
{
	struct reader *inner = reader_new(r->project, path, r->diags);

	if (!inner) {
		r->no_memory = true;
		return;
	}
	inner->outer = r;
	inner->library = library || r->library;
	inner->source = r->source;
	inner->total = r->total;
	inner->number = r->number;
	read_file(inner, text, len);
	r->no_memory |= inner->no_memory;
	reader_free(inner);
}

/* Is this path in the list? Adds it if not. */
static bool was_named(struct reader *r, const char ***list, int *count, const char *path)
{
	const char **slot;

	for (int i = 0; i < *count; i++)
		if (!strcmp((*list)[i], path))
			return true;
	slot = arena_push(&r->project->arena, list, count, sizeof(*slot));
	if (slot)
		*slot = path;
	else
		r->no_memory = true;
	return false;
}

/* Was this library read before? Notes that it is now. */
static bool was_used(struct reader *r, const char *path)
{
	struct project *project = r->project;

	return !strcmp(project->file, path) ||
	       was_named(r, &project->used, &project->used_count, path);
}

static void include_file(struct reader *r, uint32_t name, bool library,
			 struct diag place)
{
	const char *text_name = names_text(&r->project->names, name);
	const char *path = reader_path(r, r->place.file, text_name);
	enum diag_id why;
	size_t len = 0;

	if (!path || r->no_memory) {
		r->no_memory = true;
		return;
	}
	place.id = DIAG_BAD_INCLUDE;
	if (library && was_used(r, path))
		return;
	why = include_fault(r, path);
	if (why != DIAG_COUNT) {
		place.id = why;
		diag_add(r->diags, place, "%.64s", text_name);
		return;
	}
	char *text = r->source->load(r->source->context, r->place.file,
				     text_name, &len, r->diags, place);
	if (!text)
		return;
	if (!library)
		was_named(r, &r->project->included, &r->project->included_count, path);
	/* Files that name each other many times must not take very long. */
	*r->total += len + 1024;
	place.id = DIAG_INCLUDE_LARGE;
	if (*r->total > LIMIT_TEXT)
		diag_add(r->diags, place, "%.64s", text_name);
	else
		read_included(r, path, library, text, len);
	free(text);
}

static void read_include(struct reader *r, bool library)
{
	struct part part = { .kind = library ? PART_USES : PART_INCLUDE };
	struct diag place = r->place;

	place.line = r->lex.token.line;
	place.column = r->lex.token.column;
	reader_next(r);
	if (r->lex.token.kind != TOKEN_STRING)
		reader_fail_word(r, DIAG_EXPECTED, "file name in \"…\"");
	else if (reader_string(r, &part.text) && part.text == 0)
		reader_fail_word(r, DIAG_EXPECTED, "file name in \"…\"");
	else
		reader_next(r);
	if (part.text == 0) {
		reader_skip_line(r);
		return;
	}
	reader_end_line(r);
	part.comment = buffer_take(r, &r->above);
	reader_add_part(r, part);
	if (r->source)
		include_file(r, part.text, library, place);
}

/* NAMESPACE Name, END_NAMESPACE, USING Name, Other; */
static void read_space(struct reader *r)
{
	struct part part = { .kind = PART_SPACE };
	const struct token first = r->lex.token;
	const bool begins = lex_is(&r->lex, "NAMESPACE"), uses = lex_is(&r->lex, "USING");
	struct buffer line = { .text = NULL };

	if (!begins && !uses && r->spaces == 0)
		reader_fail_word(r, DIAG_ST_NO_BEGIN, "END_NAMESPACE" DIAG_AND "NAMESPACE");
	r->spaces += begins ? 1 : uses || r->spaces == 0 ? 0 : -1;
	if (begins)
		r->space = r->place, r->space.line = first.line, r->space.column = first.column;
	if (reader_take_space(r, &line)) {
		part.text = buffer_take(r, &line);
		reader_end_head(r);
		part.comment = buffer_take(r, &r->above);
		reader_add_part(r, part);
	} else {
		reader_skip_line(r);
	}
	free(line.text);
}

static void end_spaces(struct reader *r)
{
	if (r->spaces == 0)
		return;
	r->space.id = DIAG_ST_OPEN;
	diag_add(r->diags, r->space, "%s", "NAMESPACE" DIAG_AND "END_NAMESPACE");
	r->spaces = 0;
}

/* ---- words that begin a part ---- */

/* A second configuration is reported; its errors are too, its contents are dropped. */
static void read_configuration(struct reader *r)
{
	struct project *project = r->project;
	struct part part = { .kind = PART_CONFIG };
	struct config *config = arena_alloc(&project->arena, sizeof(*config));
	bool second = project->config;

	if (second)
		reader_fail_many(r, DIAG_TOO_MANY, "configurations", 1);
	if (!config) {
		r->no_memory = true;
		return;
	}
	if (!second)
		project->config = config;
	part.comment = buffer_take(r, &r->above);
	read_config(r, config);
	if (!second)
		reader_add_part(r, part);
}

/* ---- the file ---- */

/* Reports a part that a file named by USES cannot hold, because it would run or exist
 * twice. */
static bool is_foreign(const struct reader *r)
{
	return lex_is(&r->lex, "PROGRAM") || lex_is(&r->lex, "INCLUDE") ||
	       lex_is(&r->lex, "CONFIGURATION");
}

/* ACTIONS and END_ACTIONS, which stand around the actions of the POU above. */
static bool skip_actions(struct reader *r)
{
	if (!r->plain || (!lex_is(&r->lex, "ACTIONS") && !lex_is(&r->lex, "END_ACTIONS")))
		return false;
	r->actions_of = 0;
	if (lex_is(&r->lex, "ACTIONS")) {
		reader_next(r);
		if (r->lex.token.kind == TOKEN_NAME && !lex_is(&r->lex, "ACTION"))
			reader_name(r, "name of the program", &r->actions_of);
	}
	if (r->lex.token.kind == TOKEN_NAME && !lex_is(&r->lex, "ACTION"))
		reader_next(r);
	reader_end_head(r);
	return true;
}

static void read_parts(struct reader *r)
{
	enum pou_kind kind;

	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || r->no_memory)
			return;
		if (r->library && is_foreign(r))
			reader_fail_token(r, DIAG_MISPLACED);
		if (lex_is(&r->lex, "VAR_ACCESS"))
			read_global_access(r);
		else if (reader_is_vars(r))
			read_global_vars(r);
		else if (read_pou_kind(r, &kind))
			read_pou(r, kind);
		else if (lex_is(&r->lex, "TYPE"))
			read_types(r);
		else if (lex_is(&r->lex, "USES"))
			read_include(r, true);
		else if (lex_is(&r->lex, "VIEW"))
			read_view(r);
		else if (lex_is(&r->lex, "CONFIGURATION"))
			read_configuration(r);
		else if (lex_is(&r->lex, "INCLUDE"))
			read_include(r, false);
		else if (lex_is(&r->lex, "NAMESPACE") || lex_is(&r->lex, "END_NAMESPACE") || lex_is(&r->lex, "USING"))
			read_space(r);
		else if (!skip_actions(r) && !reader_skip_objects(r))
			reader_skip_odd_line(r);
	}
}

/* After a wrong first line every other message would be a consequence. */
static bool has_first_line(struct reader *r, const char *text, size_t len)
{
	r->plain = text_is_plain(text, len);
	if (r->plain)
		return true;
	lex_init(&r->lex, text, len);
	r->lex.newlines = true;
	r->lex.comments = true;
	do
		lex_next(&r->lex);
	while (r->lex.token.kind == TOKEN_NEWLINE ||
	       r->lex.token.kind == TOKEN_COMMENT);
	if (r->lex.token.kind == TOKEN_END) {
		r->lex.token.line = r->lex.token.column = 0;
		return reader_fail_word(r, DIAG_EMPTY_FILE, "");
	}
	/* A packed one begins with 1F 8B. */
	if (lex_is(&r->lex, "_FILES_CLASSICLADDER") || lex_is(&r->lex, "LDmicro0") || (r->lex.token.len && *r->lex.token.text == 0x1f))
		return reader_fail_word(r, DIAG_IMPORT_FIRST, "");
	if (!lex_is(&r->lex, "RUNGBOARD"))
		return reader_fail_word(r, DIAG_NOT_RUNGBOARD, "");
	return true;
}

/* Can it be read? Tells it if not. */
static bool is_readable(struct reader *r, const char *text, size_t len)
{
	if (len > LIMIT_TEXT) /* no line yet: the whole file */
		return reader_fail_word(r, DIAG_TOO_LARGE, "");
	if (utf16_text(text, len))
		return reader_fail_word(r, DIAG_UTF16, "");
	return has_first_line(r, text, len);
}

static void read_text(struct reader *r, const char *text, size_t len)
{
	char *copy = reader_open(r, text, len);

	if (r->plain || read_first_line(r)) {
		reader_skip_newlines(r);
		if (!r->plain)
			read_head(r);
		read_parts(r);
		end_spaces(r);
	}
	free(copy);
}

static void read_file(struct reader *r, const char *text, size_t len)
{
	if (is_readable(r, text, len))
		read_text(r, text, len);
}

/* Out of memory is reported once. */
static void fail_memory(const struct project *project, const char *file,
			bool failed, struct diag_list *diags)
{
	struct diag place = { .id = DIAG_NO_MEMORY, .file = file };

	if (failed || project->arena.failed)
		diag_add(diags, place, "%s", "");
}

/* A reader of file @number; NULL: no memory. */
static struct reader *reader_of(struct project *project, int number, const struct text_source *source,
				size_t *total, struct diag_list *diags)
{
	const char *name = project->source[number].name;
	struct reader *r = name ? reader_new(project, name, diags) : NULL;

	if (!r)
		return NULL;
	r->source = source;
	r->total = total;
	r->number = (uint16_t)number;
	r->plain = project->source[number].plain;
	return r;
}

/* The names that it declares; false: no memory. */
static bool look_ahead(struct reader *r, const struct text_file *file, int count)
{
	struct source_file *at = &r->project->source[r->number];

	at->foreign = file->foreign;
	at->read = is_readable(r, file->text, file->len);
	at->plain = r->plain;
	r->project->words.own_first |= r->plain;
	r->project->words.as_numbers |= file->foreign;
	if (at->read && count > 1 && !r->plain)
		reader_fail_word(r, DIAG_MIXED_FILES, "");
	if (at->read)
		read_words(r, file->text, file->len);
	return !r->no_memory;
}

static bool read_source(struct reader *r, const struct text_file *file)
{
	struct project *project = r->project;
	uint32_t *tail = r->number ? &project->source[r->number].tail : &project->tail;

	if (project->source[r->number].read) {
		read_text(r, file->text, file->len);
		*tail = buffer_take(r, &r->above);
	}
	return !r->no_memory;
}

/* First the names of all files, then all that they say. False: no memory. */
static bool read_files(struct project *project, const struct text_file *files, int count,
		       const struct text_source *source, struct diag_list *diags)
{
	size_t total = 0;
	bool memory = true;

	for (int i = 0; i < 2 * count && memory; i++) {
		const struct text_file *file = &files[i % count];
		struct reader *r = reader_of(project, i % count, source, &total, diags);

		if (i < count)
			total += file->len;
		memory = r && (i < count ? look_ahead(r, file, count) : read_source(r, file));
		reader_free(r);
	}
	return memory;
}

bool text_read_files(struct project *project, const struct text_file *files, int count,
		     const struct text_source *source, struct diag_list *diags)
{
	const int errors = diags->errors;
	bool memory = true;

	project->source = arena_alloc(&project->arena, (size_t)count * sizeof(*project->source));
	project->source_count = project->source ? count : 0;
	for (int i = 0; i < project->source_count; i++)
		project->source[i].name = arena_copy(&project->arena, files[i].name,
						     strlen(files[i].name));
	memory = project->source && read_files(project, files, count, source, diags);
	if (memory && project_resolve(project, diags))
		shape_make(project, diags);
	fail_memory(project, files->name, !memory, diags);
	return diags->errors == errors;
}

bool text_read(struct project *project, const char *file, const char *text,
	       size_t len, const struct text_source *source,
	       struct diag_list *diags)
{
	const struct text_file one = { file, text, len, false };

	return text_read_files(project, &one, 1, source, diags);
}

/* A comment after the last rung is kept above it. */
static uint32_t join_lines(struct reader *r, uint32_t comment)
{
	const char *text = names_text(&r->project->names, comment);

	buffer_clear(&r->text);
	buffer_add(r, &r->text, text, strlen(text));
	if (comment)
		buffer_add(r, &r->text, "\n", 1);
	buffer_add(r, &r->text, r->above.text, r->above.len);
	return buffer_take(r, &r->text);
}

struct rung *text_read_rung(struct project *project, const char *text,
			    size_t len, struct diag_list *diags)
{
	const int errors = diags->errors;
	struct reader *r = reader_new(project, "", diags);
	struct rung *rung = NULL;
	struct pou pou = { .language = LANGUAGE_LD };
	char *copy = NULL;

	if (r && len <= LIMIT_TEXT) {
		r->place.rung = 1;
		copy = reader_open(r, text, len);
		reader_skip_newlines(r);
		if (lex_is(&r->lex, "RUNG"))
			rung = read_rung(r, &pou);
		else
			reader_fail_word(r, DIAG_EXPECTED, "RUNG");
		if (rung && r->lex.token.kind != TOKEN_END)
			reader_fail_token(r, DIAG_SYNTAX);
		if (rung && r->above.len > 0)
			rung->comment = join_lines(r, rung->comment);
	}
	fail_memory(project, "", !r || r->no_memory, diags);
	free(copy);
	reader_free(r);
	if (diags->errors == errors)
		return rung;
	rung_free(rung);
	return NULL;
}

static bool push_var(struct reader *r, struct var_table *table, int block,
		     const char *text, size_t len)
{
	struct var var;
	char *copy = reader_open(r, text, len);
	bool good;

	reader_skip_newlines(r);
	good = read_var(r, table->block[block].flags, &var);
	if (good && (var.named ? !named_take(r->project, &var) : !named_default(r->project, &var)))
		r->no_memory = true;
	if (good && table->count == LIMIT_VARS)
		good = reader_fail_many(r, DIAG_TOO_MANY, "variables", LIMIT_VARS);
	if (good && !vars_push(table, block, &var, &r->project->arena))
		r->no_memory = true;
	free(copy);
	return good && !r->no_memory;
}

bool text_read_var(struct project *project, struct pou *pou, int block,
		   const char *text, size_t len, struct diag_list *diags)
{
	struct reader *r = reader_new(project, "", diags);
	bool good = false;

	if (r && len <= LIMIT_TEXT) {
		r->pou = pou;
		good = push_var(r, pou ? &pou->vars : &project->globals, block, text, len);
	}
	fail_memory(project, "", !r || r->no_memory, diags);
	reader_free(r);
	return good;
}
