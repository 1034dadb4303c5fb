/* SPDX-License-Identifier: MIT
 *
 * read_config - CONFIGURATION … END_CONFIGURATION: RESOURCE, TASK, PROGRAM, AREA and the
 * VAR blocks between them.
 *
 * Values are checked here, names in check/. A comment belongs to the line that it follows
 * or precedes; the last comments belong to the last line.
 */
#include "engine/text/reader.h"

#include "engine/model/st.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"

#include <stdio.h>
#include <string.h>

static bool step_past(struct reader *r, const char *symbol)
{
	if (!lex_is(&r->lex, symbol))
		return reader_fail_word(r, DIAG_EXPECTED, symbol);
	reader_step(r);
	return true;
}

/* ---- TASK ---- */

static bool read_time(struct reader *r, int64_t *ns, uint32_t *text, bool zero)
{
	const struct token *token = &r->lex.token;
	struct literal literal;

	if (token->kind != TOKEN_NUMBER && token->kind != TOKEN_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "time such as T#10ms");
	if (literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
	    literal.type != IEC_TIME)
		return reader_fail_token(r, DIAG_BAD_LITERAL);
	if (zero && literal.value.i == 0) { /* as if it were not given */
		reader_step(r);
		return true;
	}
	if (literal.value.i < LIMIT_TICK || literal.value.i > LIMIT_INTERVAL)
		return reader_fail_token(r, DIAG_BAD_INTERVAL);
	*ns = literal.value.i;
	*text = reader_intern(r, token->text, token->len);
	reader_step(r);
	return true;
}

/* Digits only; UINT32_MAX: more than @most. The token is not stepped past. */
static bool parse_count(struct reader *r, uint32_t most, uint32_t *out)
{
	const struct token *token = &r->lex.token;

	*out = 0;
	if (token->kind != TOKEN_NUMBER)
		return reader_fail_word(r, DIAG_EXPECTED, "number");
	for (size_t i = 0; i < token->len; i++) {
		if (!ascii_digit(token->text[i]))
			return reader_fail_token(r, DIAG_BAD_LITERAL);
		if (*out != UINT32_MAX)
			*out = *out * 10 + (uint32_t)(token->text[i] - '0');
		if (*out > most)
			*out = UINT32_MAX;
	}
	return true;
}

static bool read_count(struct reader *r, uint32_t most, uint32_t *out)
{
	if (!parse_count(r, most, out))
		return false;
	if (*out == UINT32_MAX)
		return reader_fail_token(r, DIAG_LITERAL_RANGE);
	reader_step(r);
	return true;
}

static bool read_single(struct reader *r, uint32_t *single)
{
	const struct token word = r->lex.token;

	buffer_clear(&r->text);
	if (!reader_value(r, false, &word))
		return false;
	*single = buffer_take(r, &r->text);
	reader_step(r);
	return true;
}

enum setting { SET_INTERVAL, SET_SINGLE, SET_PRIORITY, SET_WATCHDOG, SETTINGS };
static const char *const setting_word[SETTINGS] = {
	"INTERVAL", "SINGLE", "PRIORITY", "WATCHDOG",
};

/* Has the task a SINGLE, too? Then INTERVAL := T#0s means none. */
static bool has_single(const struct reader *r, unsigned int given)
{
	struct lex lex = r->lex;

	while (!lex_is(&lex, ")") && !lex_is(&lex, ";") && !lex_is(&lex, "SINGLE") &&
	       lex.token.kind != TOKEN_END)
		lex_next(&lex);
	return given & 1u << SET_SINGLE || lex_is(&lex, "SINGLE");
}

/* NAME := VALUE; sets the bit of the setting in @given. */
static bool read_setting(struct reader *r, struct config_entry *entry,
			 unsigned int *given)
{
	int which = 0;

	while (which < SETTINGS && !lex_is(&r->lex, setting_word[which]))
		which++;
	if (which == SETTINGS)
		return reader_fail_word(r, DIAG_EXPECTED,
					"INTERVAL, SINGLE, PRIORITY or WATCHDOG");
	if (*given & 1u << which)
		return reader_fail_token(r, DIAG_DUPLICATE_ARG);
	*given |= 1u << which;
	reader_step(r);
	if (!step_past(r, ":="))
		return false;
	switch ((enum setting)which) {
	case SET_INTERVAL:
		return read_time(r, &entry->interval_ns, &entry->interval,
				 r->plain || has_single(r, *given));
	case SET_SINGLE:
		return read_single(r, &entry->single);
	case SET_PRIORITY:
		return read_count(r, UINT16_MAX, &entry->priority);
	case SET_WATCHDOG:
		return read_time(r, &entry->watchdog_ns, &entry->watchdog, false);
	case SETTINGS:
		break;
	}
	return false;
}

static bool read_task(struct reader *r, struct config_entry *entry)
{
	unsigned int given = 0;
	bool more;

	if (!reader_name(r, "name of the task", &entry->name))
		return false;
	reader_step(r);
	if (!step_past(r, "("))
		return false;
	do {
		if (!read_setting(r, entry, &given))
			return false;
		more = reader_is(r, ',');
		if (more)
			reader_step(r);
	} while (more);
	if (!entry->interval)
		given &= ~(1u << SET_INTERVAL);
	if (r->plain && !(given & (1u << SET_INTERVAL | 1u << SET_SINGLE))) { /* as a program without a task */
		entry->interval_ns = INT64_C(10000000);
		entry->interval = reader_intern(r, "T#10ms", 6);
		given |= 1u << SET_INTERVAL;
	}
	if (!(given & 1u << SET_INTERVAL) == !(given & 1u << SET_SINGLE))
		return reader_fail_word(r, DIAG_EXPECTED,
					"either INTERVAL or SINGLE");
	return step_past(r, ")");
}

/* ---- PROGRAM, AREA ---- */

static void add_text(struct reader *r, const char *text, size_t len)
{
	buffer_add(r, &r->text, text, len);
}

/* `Pump WITH Fast`; the name was read. */
static bool read_called(struct reader *r, struct config_entry *entry, uint32_t name)
{
	struct block_task called = { .name = name }, *slot;

	reader_step(r);
	if (!reader_name(r, "name of the task", &called.task))
		return false;
	reader_step(r);
	slot = arena_push(&r->project->arena, &entry->called, &entry->calls, sizeof(*slot));
	if (!slot)
		return r->no_memory = true, false;
	*slot = called;
	return true;
}

/* `Input := value` or `Output => place`, kept as assignments; or `Pump WITH Fast`. */
static bool read_value(struct reader *r, struct config_entry *entry)
{
	struct st_item item = { .kind = ST_ASSIGN, .line = r->lex.token.line,
				.column = r->lex.token.column };
	struct st_item *slot;
	uint32_t name;

	if (!reader_name(r, "name of an input or output", &name))
		return false;
	const char *text = names_text(&r->project->names, name);
	const size_t len = names_len(&r->project->names, name);

	reader_step(r);
	if (lex_is(&r->lex, "WITH"))
		return read_called(r, entry, name);
	item.behind = lex_is(&r->lex, "=>");
	if (!item.behind && !lex_is(&r->lex, ":="))
		return reader_fail_word(r, DIAG_EXPECTED, ":= or =>");
	reader_step(r);
	buffer_clear(&r->text);
	if (!item.behind) {
		add_text(r, text, len);
		add_text(r, " := ", 4);
	}
	if (!reader_expression_text(r))
		return false;
	if (item.behind) {
		add_text(r, " := ", 4);
		add_text(r, text, len);
	}
	item.text = buffer_take(r, &r->text);
	slot = arena_push(&r->project->arena, &entry->value, &entry->values, sizeof(*slot));
	if (!slot)
		return r->no_memory = true, false;
	*slot = item;
	return true;
}

/* `(In := 5, Out => Level)` behind the name of a program. */
static bool read_values(struct reader *r, struct config_entry *entry)
{
	if (!reader_is(r, '('))
		return true;
	do {
		reader_step(r);
		if (!read_value(r, entry))
			return false;
	} while (reader_is(r, ','));
	return step_past(r, ")");
}

static bool read_instance(struct reader *r, struct config_entry *entry)
{
	if (!reader_name(r, "name of the program", &entry->name))
		return false;
	reader_step(r);
	if (lex_is(&r->lex, "WITH")) {
		reader_step(r);
		if (!reader_name(r, "name of the task", &entry->task))
			return false;
		reader_step(r);
	}
	if (!step_past(r, ":") ||
	    !reader_name(r, "name of the program", &entry->pou))
		return false;
	reader_step(r);
	return read_values(r, entry);
}

static bool read_area_size(struct reader *r, const struct iec_area_row *row,
			   uint32_t *out)
{
	char bounds[LIMIT_ARG];

	if (!parse_count(r, row->most, out))
		return false;
	if (row->least == row->most && *out != row->most) {
		snprintf(bounds, sizeof(bounds), "%s" DIAG_AND "%u", row->letters,
			 (unsigned)row->most);
		return reader_fail_word(r, DIAG_AREA_FIXED, bounds);
	}
	if (*out < row->least || *out > row->most) {
		snprintf(bounds, sizeof(bounds), "%s" DIAG_AND "%u" DIAG_AND "%u",
			 row->letters, (unsigned)row->least, (unsigned)row->most);
		return reader_fail_word(r, DIAG_AREA_SIZE, bounds);
	}
	reader_step(r);
	return true;
}

static bool read_area(struct reader *r, struct config_entry *entry)
{
	const struct token *token = &r->lex.token;

	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++)
		if (token->kind == TOKEN_NAME &&
		    ascii_is(iec_area_row((enum iec_area)area)->letters,
			     token->text, token->len))
			entry->area = (enum iec_area)area;
	if (entry->area == AREA_NONE)
		return reader_fail_word(r, DIAG_EXPECTED,
					"letters of an area, such as V");
	reader_step(r);
	return read_area_size(r, iec_area_row(entry->area), &entry->bytes);
}

/* ---- lines ---- */

static struct config_entry *add_entry(struct reader *r, struct config *config,
				    struct config_entry entry)
{
	struct config_entry *slot = NULL;

	if (config->count == 2 * LIMIT_POUS)
		reader_fail_many(r, DIAG_TOO_MANY, "lines of a configuration", 2 * LIMIT_POUS);
	else if (!(slot = arena_push(&r->project->arena, &config->entry,
				     &config->count, sizeof(entry))))
		r->no_memory = true;
	if (slot)
		*slot = entry;
	return slot;
}

static bool has_tasks(const struct config *config, int most)
{
	for (int i = 0; i < config->count; i++)
		most -= config->entry[i].kind == CONFIG_TASK;
	return most <= 0;
}

static void read_entry(struct reader *r, struct config *config, bool inside)
{
	struct config_entry entry = { .inside = inside,
				    .line = r->lex.token.line };
	bool good;

	r->across_lines = true;
	if (lex_is(&r->lex, "TASK")) {
		entry.kind = CONFIG_TASK;
		/* One of LIMIT_TASKS is for programs without a task. */
		if (has_tasks(config, LIMIT_TASKS - 1))
			reader_fail_many(r, DIAG_TOO_MANY, "tasks", LIMIT_TASKS - 1);
		reader_step(r);
		good = read_task(r, &entry);
	} else if (lex_is(&r->lex, "PROGRAM")) {
		entry.kind = CONFIG_PROGRAM;
		reader_step(r);
		good = read_instance(r, &entry);
	} else {
		entry.kind = CONFIG_AREA;
		reader_step(r);
		good = read_area(r, &entry);
	}
	r->across_lines = false;
	if (good && !reader_is(r, ';'))
		good = reader_fail_word(r, DIAG_EXPECTED, ";");
	if (!good) {
		reader_skip_declaration(r);
		return;
	}
	reader_next(r); /* a comment on the same line belongs to this task or program */
	entry.comment = buffer_take(r, &r->note);
	add_entry(r, config, entry);
}

static void read_block(struct reader *r, struct config *config, bool inside)
{
	struct project *project = r->project;
	struct config_entry entry = { .kind = CONFIG_VARS, .inside = inside,
				    .line = r->lex.token.line };

	entry.block = project->globals.block_count;
	read_vars(r, &project->globals, true);
	if (project->globals.block_count > entry.block)
		add_entry(r, config, entry);
}

static void read_access_block(struct reader *r, struct config *config)
{
	struct config_entry entry = { .kind = CONFIG_ACCESS, .line = r->lex.token.line };

	entry.block = read_access(r);
	if (entry.block >= 0)
		add_entry(r, config, entry);
}

static void read_located_block(struct reader *r, struct config *config, bool inside)
{
	struct config_entry entry = { .kind = CONFIG_LOCATED, .inside = inside,
				    .line = r->lex.token.line };

	entry.block = read_located(r);
	if (entry.block >= 0)
		add_entry(r, config, entry);
}

/* A word that cannot begin a line here ends the block. */
static bool ends_config(const struct reader *r)
{
	return r->lex.token.kind == TOKEN_END || r->no_memory ||
	       lex_is(&r->lex, "END_CONFIGURATION") ||
	       lex_is(&r->lex, "END_PROGRAM") || lex_is(&r->lex, "RUNG") ||
	       lex_is(&r->lex, "INCLUDE") || lex_is(&r->lex, "VIEW");
}

/* Where a comment behind a line is kept: behind the last line of a block, if that has one. */
static uint32_t *comment_of(struct project *project, struct config_entry *entry)
{
	struct var_block *vars;
	struct access_block *access;

	if (entry->kind == CONFIG_VARS || entry->kind == CONFIG_LOCATED) {
		struct var_table *table = entry->kind == CONFIG_VARS ? &project->globals :
								       &project->located;

		vars = &table->block[entry->block];
		return vars->count ? &table->var[vars->first + vars->count - 1].comment :
				     &vars->comment;
	}
	if (entry->kind == CONFIG_ACCESS) {
		access = &project->access_block[entry->block];
		return access->count ?
		       &project->access[access->first + access->count - 1].var.comment :
		       &access->comment;
	}
	return &entry->comment;
}

static void read_entries(struct reader *r, struct config *config, bool inside);

/* Keeps the comments before END_RESOURCE. */
static void keep_inside(struct reader *r, struct config *config)
{
	uint32_t *id = config->count > config->resource_at ?
		       comment_of(r->project, &config->entry[config->count - 1]) :
		       &config->resource_inside;

	*id = comment_join(r, *id, &r->note, COMMENT_NOTE);
}

/* `RESOURCE Name ON Kind`; the comment is in r->note. False: it has no name. */
static bool read_resource_head(struct reader *r, uint32_t *name, uint32_t *on)
{
	bool good = false;

	*on = 0;
	reader_next(r);
	if (reader_name(r, "name of the resource", name)) {
		good = true;
		reader_next(r);
		if (lex_is(&r->lex, "ON")) {
			reader_next(r);
			if (reader_name(r, "kind of the resource", on))
				reader_next(r);
		}
	}
	reader_end_head(r);
	return good;
}

static bool same_text(const struct reader *r, uint32_t a, uint32_t b)
{
	return a && b && name_equal(project_text(r->project, a), project_text(r->project, b));
}

/* `Name` of a later RESOURCE, at @line, is Resource_Name. */
static uint32_t in_resource(struct reader *r, uint32_t resource, uint32_t name, int line)
{
	struct diag place = { .id = DIAG_NAME_TOO_LONG, .file = r->place.file, .line = line };
	const size_t room = LIMIT_NAME + 1;
	char *text = arena_alloc(&r->project->arena, room);
	const int len = text ? snprintf(text, room, "%s_%s", project_text(r->project, resource),
					project_text(r->project, name)) : 0;

	if (!text) /* the arena tells it at the end */
		return name;
	if (len > 0 && len <= LIMIT_NAME)
		return reader_intern(r, text, (size_t)len);
	diag_add(r->diags, place, "%.30s_%.30s", project_text(r->project, resource), project_text(r->project, name));
	return name;
}

/* The same for `Pump WITH Slow` of @entry, if @task is that one. */
static void part_called(struct reader *r, struct config_entry *entry, const struct config_entry *task)
{
	for (int i = 0; i < entry->calls && task->kind == CONFIG_TASK && task->own_name; i++) {
		struct block_task *called = &entry->called[i];

		if (called->own_task || !same_text(r, task->own_name, called->task))
			continue;
		called->own_task = called->task;
		called->task = task->name;
	}
}

/* Tasks and programs from entry @from on get names that no earlier RESOURCE has: all run on one processor. */
static void part_names(struct reader *r, struct config *config, int from, uint32_t resource)
{
	for (int i = from; i < config->count; i++) {
		struct config_entry *entry = &config->entry[i];
		bool taken = false;

		for (int k = 0; k < from && !taken; k++)
			taken = config->entry[k].kind == entry->kind && same_text(r, config->entry[k].name, entry->name);
		if (!taken || (entry->kind != CONFIG_TASK && entry->kind != CONFIG_PROGRAM))
			continue;
		entry->own_name = entry->name;
		entry->name = in_resource(r, resource, entry->name, entry->line);
	}
	for (int i = from; i < config->count; i++)
		for (int k = from; k < config->count; k++) {
			struct config_entry *entry = &config->entry[i];
			const struct config_entry *task = &config->entry[k];

			if (entry->kind != CONFIG_PROGRAM || entry->own_task || task->kind != CONFIG_TASK ||
			    !task->own_name || !same_text(r, task->own_name, entry->task))
				continue;
			entry->own_task = entry->task;
			entry->task = task->name;
		}
	for (int i = from; i < config->count; i++)
		for (int k = from; k < config->count; k++)
			part_called(r, &config->entry[i], &config->entry[k]);
}

/* Another RESOURCE behind the first one: an entry, and those in it behind it. */
static void read_further_resource(struct reader *r, struct config *config)
{
	const struct token head = r->lex.token;
	struct config_entry entry = { .kind = CONFIG_RESOURCE, .inside = true, .line = head.line };
	struct config_entry *at;
	int from;

	read_resource_head(r, &entry.name, &entry.pou);
	entry.comment = buffer_take(r, &r->note);
	if (!add_entry(r, config, entry))
		return;
	from = config->count;
	read_entries(r, config, true);
	if (!lex_is(&r->lex, "END_RESOURCE")) {
		reader_fail_open(r, &head);
		return;
	}
	at = &config->entry[config->count - 1];
	if (config->count > from) {
		uint32_t *id = comment_of(r->project, at);

		*id = comment_join(r, *id, &r->note, COMMENT_NOTE);
	} else {
		at->comment = comment_join(r, at->comment, &r->note, COMMENT_NOTE);
	}
	part_names(r, config, from, entry.name);
	reader_next(r);
	reader_end_head(r);
	config->entry[from - 1].task = buffer_take(r, &r->note);
}

static void read_resource(struct reader *r, struct config *config)
{
	const struct token head = r->lex.token;

	if (config->has_resource) {
		read_further_resource(r, config);
		return;
	}
	config->has_resource = read_resource_head(r, &config->resource, &config->on);
	config->resource_comment = buffer_take(r, &r->note);
	config->resource_at = config->count;
	read_entries(r, config, true);
	if (!lex_is(&r->lex, "END_RESOURCE")) {
		reader_fail_open(r, &head);
		return;
	}
	keep_inside(r, config);
	reader_next(r);
	reader_end_head(r);
	config->resource_behind = buffer_take(r, &r->note);
}

/* A second level only for lines in a RESOURCE. */
static void read_entries(struct reader *r, struct config *config, bool inside)
{
	for (;;) {
		reader_skip_newlines(r);
		if (ends_config(r) || lex_is(&r->lex, "END_RESOURCE"))
			return;
		if (lex_is(&r->lex, "VAR") || lex_is(&r->lex, "VAR_GLOBAL"))
			read_block(r, config, inside);
		else if (lex_is(&r->lex, "VAR_CONFIG"))
			read_located_block(r, config, inside);
		else if (lex_is(&r->lex, "VAR_ACCESS") && inside)
			reader_misplaced_access(r); /* behind the RESOURCE */
		else if (lex_is(&r->lex, "VAR_ACCESS"))
			read_access_block(r, config);
		else if (lex_is(&r->lex, "TASK") ||
			 lex_is(&r->lex, "PROGRAM") || lex_is(&r->lex, "AREA"))
			read_entry(r, config, inside);
		else if (!inside && lex_is(&r->lex, "RESOURCE"))
			read_resource(r, config);
		else {
			reader_fail_token(r, DIAG_SYNTAX);
			reader_skip_line(r);
		}
	}
}

static void keep_last_comments(struct reader *r, struct config *config)
{
	const int count = config->count;
	uint32_t *id = &config->comment;
	int last = count - 1;

	while (last >= 0 && config->entry[last].kind != CONFIG_RESOURCE)
		last--;

	if (config->has_resource && (count == config->resource_at || config->entry[count - 1].inside))
		id = last >= 0 ? &config->entry[last].task : &config->resource_behind;
	else if (count)
		id = comment_of(r->project, &config->entry[count - 1]);
	*id = comment_join(r, *id, &r->note, COMMENT_NOTE);
}

void read_config(struct reader *r, struct config *config)
{
	const struct token head = r->lex.token;

	config->file = r->place.file;
	config->line = head.line;
	r->comments = COMMENT_NOTE;
	reader_next(r);
	if (reader_name(r, "name of the configuration", &config->name))
		reader_next(r);
	reader_end_head(r);
	config->comment = buffer_take(r, &r->note);
	read_entries(r, config, false);
	if (lex_is(&r->lex, "END_RESOURCE")) {
		reader_fail_token(r, DIAG_MISPLACED);
		reader_skip_line(r);
		read_entries(r, config, false);
	}
	keep_last_comments(r, config);
	r->comments = COMMENT_ABOVE;
	if (!lex_is(&r->lex, "END_CONFIGURATION")) {
		reader_fail_open(r, &head);
		return;
	}
	reader_next(r);
	reader_end_head(r);
}
