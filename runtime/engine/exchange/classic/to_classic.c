/* SPDX-License-Identifier: MIT
 *
 * to_classic - sections and settings of an export to ClassicLadder, and the order of programs.
 */
#include "engine/base/ascii.h"
#include "engine/exchange/classic/to_classic_parts.h"
#include "engine/exchange/foreign_text.h"

#include <stdio.h>
#include <string.h>

/* ---- messages ---- */

const char *out_text(struct leaving *e, const char *format, ...)
{
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(e->arena, format, args);
	va_end(args);
	e->good &= text != NULL;
	return text ? text : "";
}

static struct diag place_of(const struct leaving *e, enum diag_id id)
{
	struct diag place = { .id = id, .file = e->project->file };
	const struct rung *rung;

	if (!e->pou)
		return place;
	place.file = e->pou->file ? e->pou->file : e->project->file;
	place.pou = project_text(e->project, e->pou->name);
	place.line = e->pou->line;
	if (e->rung_index >= 0 && e->rung_index < e->pou->rung_count) {
		rung = e->pou->rung[e->rung_index];
		place.line = rung_line(rung, e->row);
		place.rung = e->pou->sfc ? 0 : e->rung_index + 1;
		place.row = e->row;
		place.col = e->col;
	}
	return place;
}

bool out_refuse(struct leaving *e, enum diag_id id, const char *format, ...)
{
	char text[LIMIT_ARG];
	va_list args;

	va_start(args, format);
	vsnprintf(text, sizeof(text), format, args);
	va_end(args);
	if (e->good)
		diag_add(e->diags, place_of(e, id), "%s", text);
	e->good = false;
	return false;
}

static __attribute__((format(printf, 4, 0)))
void tell_at(struct leaving *e, enum report_kind kind, struct diag place, const char *format,
	     va_list args)
{
	struct report_line line = { .kind = kind, .member = "",
		.line = place.line, .pou = place.pou, .rung = place.rung };
	char text[400];

	vsnprintf(text, sizeof(text), report_said(e->report, format), args);
	for (int i = 0; i < e->report->count; i++)
		if (!strcmp(e->report->line[i].text, text))
			return;
	report_add(e->report, line, "%s", text);
}

void tell_change(struct leaving *e, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_CHANGED, place_of(e, DIAG_NO_MEMORY), format, args);
	va_end(args);
}

void tell_lost(struct leaving *e, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_LOST, place_of(e, DIAG_NO_MEMORY), format, args);
	va_end(args);
}

void tell_line(struct leaving *e, int line, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell_at(e, REPORT_CHANGED, (struct diag){ .line = line }, format, args);
	va_end(args);
}

/* ---- rungs ---- */

/* The text of a title without its quotes and `$`. */
static const char *plain_title(struct leaving *e, const char *text)
{
	char *copy = arena_copy(e->arena, text, strlen(text)), *to = copy;
	bool quoted = text[0] == '"';

	for (const char *at = text + quoted; copy && *at; at++) {
		if (quoted && *at == '"' && !at[1])
			break;
		if (*at == '$' && at[1])
			at++;
		*to++ = *at;
	}
	if (copy)
		*to = '\0';
	return copy ? copy : "";
}

static void check_head(struct leaving *e, const struct classic_rung *rung)
{
	const int most = e->dialect == CLASSIC_UPSTREAM ? CLASSIC_COMMENT_LONG :
							  CLASSIC_COMMENT;

	if (strlen(rung->label) > CLASSIC_LABEL)
		tell_change(e, "label %s is cut to %d bytes", rung->label, CLASSIC_LABEL);
	if (strlen(rung->comment) > (size_t)most)
		tell_change(e, "a title is cut to %d bytes: %s", most, rung->comment);
}

struct classic_rung *rung_begin(struct leaving *e)
{
	struct classic_rung *rung = arena_alloc(e->arena, sizeof(*rung)), **slot;
	int number = e->out->rungs;

	if (!e->good || !rung || !e->section)
		return NULL;
	if (number >= 1900) {
		out_refuse(e, DIAG_EXPORT_MANY, "%d", number);
		return NULL;
	}
	slot = arena_push(e->arena, &e->out->rung, &e->out->rungs, sizeof(*slot));
	if (!slot)
		return NULL;
	*slot = rung;
	for (int i = 0; i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].variable =
			variable_of(0, 0);
	rung->number = number;
	rung->label = e->rung_label ? project_text(e->project, e->rung_label) : "";
	rung->comment = e->comment ? plain_title(e, e->comment) : "";
	check_head(e, rung);
	e->rung_label = 0;
	e->comment = NULL;
	rung->previous = e->section->first < 0 ? -1 : number - 1;
	rung->next = -1;
	if (e->section->first < 0)
		e->section->first = number;
	else
		e->out->rung[number - 1]->next = number;
	e->section->last = number;
	return rung;
}

int add_expression(struct leaving *e, const char *text)
{
	struct classic_expression *one;

	for (int i = 0; i < e->out->expressions; i++)
		if (!strcmp(e->out->expression[i].text, text))
			return i;
	if (e->out->expressions >= CLASSIC_LIMIT - 1) {
		out_refuse(e, DIAG_EXPORT_MANY, "%s", text);
		return 0;
	}
	one = arena_push(e->arena, &e->out->expression, &e->out->expressions, sizeof(*one));
	if (!one)
		return 0;
	one->number = e->out->expressions - 1;
	one->text = text;
	return one->number;
}

void note_jump(struct leaving *e, struct classic_cell *cell, const struct out_part *item)
{
	struct out_jump *jump = arena_push(e->arena, &e->jump, &e->jumps, sizeof(*jump));

	if (jump)
		*jump = (struct out_jump){ cell, item->label, item->leaves };
}

int routine_number(struct leaving *e, uint32_t name)
{
	const struct pou *pou = scope_pou(e->scope, e->pou, name);

	for (int i = 0; pou && i < e->routines; i++)
		if (e->routine[i] == pou)
			return i;
	return -1;
}

/* ---- sections ---- */

static bool name_taken(const struct leaving *e, const char *name)
{
	for (int i = 0; i + 1 < e->out->sections; i++)
		if (!strcmp(e->out->section[i].name, name))
			return true;
	return false;
}

void section_begin(struct leaving *e, const char *name, int subroutine, bool sequential)
{
	struct classic_section *section = arena_push(e->arena, &e->out->section,
		&e->out->sections, sizeof(*section));

	e->labels = e->jumps = 0;
	e->label = NULL;
	e->jump = NULL;
	e->section = section;
	if (!section)
		return;
	*section = (struct classic_section){ .number = e->out->sections - 1,
		.sequential = sequential, .subroutine = subroutine, .first = -1,
		.last = -1 };
	section->name = out_text(e, "%.*s", classic_cut(name, CLASSIC_SECTION_NAME), name);
	for (int i = 2; name_taken(e, section->name) && i < 1000; i++)
		section->name = out_text(e, "%.*s_%d",
			classic_cut(name, CLASSIC_SECTION_NAME - 4), name, i);
	if (strcmp(name, section->name) != 0)
		tell_change(e, "section %s is called %s in ClassicLadder", name, section->name);
}

static void patch_jumps(struct leaving *e)
{
	int end = -1;

	for (int i = 0; i < e->jumps; i++) {
		const struct out_jump *jump = &e->jump[i];
		int to = -1;

		if (jump->leaves) {
			if (end < 0) {
				e->rung_label = 0;
				e->comment = NULL;
				end = rung_begin(e) ? e->out->rungs - 1 : 0;
			}
			to = end;
		}
		for (int k = 0; k < e->labels && to < 0; k++)
			if (e->label[k].label == jump->label)
				to = e->label[k].number;
		jump->cell->variable = variable_of(0, to < 0 ? 0 : to);
	}
}

void section_end(struct leaving *e, bool drop)
{
	if (!e->section)
		return;
	patch_jumps(e);
	if (drop && e->section->first < 0) {
		e->out->sections--;
	} else if (e->section->first < 0 && !e->section->sequential) {
		rung_begin(e);
	} else if (e->section->sequential) {
		e->section->first = e->section->last = 0;
	}
	e->section = NULL;
}

/* ---- programs that an import adds, and ClassicLadder does not need ---- */

static bool writes_only(struct leaving *e, const struct pou *pou,
			bool (*may)(struct leaving *e, const struct pou *pou,
				    const struct cell *cell))
{
	if (pou->kind != POU_PROGRAM || pou->sfc || !pou->rung_count)
		return false;
	for (int i = 0; i < pou->rung_count; i++)
		for (int k = 0; k < pou->rung[i]->rows * pou->rung[i]->cols; k++) {
			const struct cell *cell = &pou->rung[i]->cell[k];
			const struct word_row *row = scope_row(e->scope,
							       (enum word)cell->word);

			if (cell->word == ELEM_EMPTY || row->place == PLACE_WIRE ||
			    row->place == PLACE_SERIES)
				continue;
			if (!may(e, pou, cell))
				return false;
		}
	return true;
}

static const struct out_slot *target_slot(struct leaving *e, const struct pou *pou,
					  const char *text, size_t len)
{
	uint32_t id = names_intern(&e->project->names, text, len);
	enum diag_id why;
	const struct meaning *m = scope_find(e->scope, pou, id, &why);

	return m && m->kind == MEANING_VARIABLE ? slot_find(e, m->var) : NULL;
}

/* Writes a system bit or word, which ClassicLadder sets itself. */
static bool writes_system(struct leaving *e, const struct pou *pou,
			  const struct cell *cell)
{
	const char *text = project_text(e->project, cell->operand);
	const struct out_slot *slot = target_slot(e, pou, text, strcspn(text, " :"));

	return slot && (slot->type == CL_SYSTEM_BIT || slot->type == CL_INPUT_SYSTEM_WORD ||
			slot->pou == pou);
}

static bool is_step(struct leaving *e, const struct pou *pou, const struct cell *cell)
{
	const char *text = project_text(e->project, cell->operand);
	const struct out_slot *slot = target_slot(e, pou, text, strlen(text));

	return slot && slot->type == CL_STEP_BIT;
}

/* Writes bits of steps of other pages, or their times. */
static bool writes_steps(struct leaving *e, const struct pou *pou, const struct cell *cell)
{
	return cell->word == FB_CL_STEP ||
	       (cell->word == ELEM_COIL_SET && is_step(e, pou, cell));
}

/* Reads nothing but the first scan and steps. */
static bool asks_steps(struct leaving *e, const struct pou *pou)
{
	for (int i = 0; i < pou->rung_count; i++)
		for (int k = 0; k < pou->rung[i]->rows * pou->rung[i]->cols; k++) {
			const struct cell *cell = &pou->rung[i]->cell[k];

			if (scope_row(e->scope, (enum word)cell->word)->place !=
				    PLACE_SERIES || is_step(e, pou, cell))
				continue;
			if (cell->word != ELEM_CONTACT_NO ||
			    strcmp(project_text(e->project, cell->operand),
				   "SYS_FIRST_SCAN") != 0)
				return false;
		}
	return true;
}

static bool is_needless(struct leaving *e, const struct pou *pou)
{
	const char *name = project_text(e->project, pou->name);

	return (!strncmp(name, "SystemBits", 10) && writes_only(e, pou, writes_system)) ||
	       (strstr(name, "_Others") && asks_steps(e, pou) &&
		writes_only(e, pou, writes_steps));
}

/* ---- order of programs ---- */

static const struct config_entry *task_of(const struct config *config, uint32_t name)
{
	for (int i = 0; i < config->count; i++)
		if (config->entry[i].kind == CONFIG_TASK && config->entry[i].name == name)
			return &config->entry[i];
	return NULL;
}

static const struct pou *program_named(const struct project *project, uint32_t name)
{
	const char *text = project_text(project, name);
	const int pou = project_find_pou(project, text, strlen(text));

	return pou >= 0 ? &project->pou[pou] : NULL;
}

/* Programs of the task in their order. false: more than one task, reported. */
static bool find_order(struct leaving *e, const struct pou **list, int *count)
{
	const struct config *config = e->project->config;
	uint32_t task = 0;
	bool first = true;

	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		const struct config_entry *its;
		const struct diag place = { .id = DIAG_EXPORT_TASK, .file = config->file,
					    .line = entry->line };

		if (entry->kind != CONFIG_PROGRAM)
			continue;
		its = task_of(config, entry->task);
		if ((!first && entry->task != task) || (its && its->single)) {
			e->good = false;
			return diag_add(e->diags, place, "%s",
					project_text(e->project, entry->name));
		}
		if (its && its->interval_ns) {
			e->out->period = (int)((its->interval_ns + 500000) / 1000000);
			e->out->period += !e->out->period;
			e->has_period = true;
		}
		task = entry->task;
		first = false;
		list[(*count)++] = program_named(e->project, entry->pou);
	}
	return true;
}

/* POUs in the order of the file, programs in the order of their task. */
static int all_pous(struct leaving *e, const struct pou **out)
{
	const struct project *project = e->project;
	const struct pou **order = arena_alloc(e->arena, sizeof(*order) *
		(size_t)(project->pou_count + (project->config ? project->config->count :
					       0) + 1));
	int ordered = 0, next = 0, count = 0;

	if (!order || !find_order(e, order, &ordered))
		return 0;
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		if (pou_has_frame(pou))
			continue;
		if (pou->kind != POU_PROGRAM || !ordered)
			out[count++] = pou;
		else if (next < ordered)
			out[count++] = order[next++];
	}
	return count;
}

/* ---- one POU ---- */

static void leave_ladder(struct leaving *e, const struct pou *pou)
{
	int routine = -1;

	for (int i = 0; i < e->routines; i++)
		if (e->routine[i] == pou)
			routine = i;
	if (pou->kind == POU_PROGRAM && is_needless(e, pou)) {
		tell_change(e, "ClassicLadder does what this program does itself");
		return;
	}
	section_begin(e, project_text(e->project, pou->name), routine, false);
	leave_temporaries(e, pou);
	for (int i = 0; i < pou->rung_count && e->good; i++) {
		e->rung_index = i;
		e->row = e->col = 0;
		leave_rung(e, pou->rung[i]);
	}
	section_end(e, false);
}

static void leave_pou(struct leaving *e, const struct pou *pou, int *page)
{
	e->pou = pou;
	e->rung_index = -1;
	e->row = e->col = 0;
	e->spares = e->helpers_used = 0;
	e->spare = NULL;
	if (pou->sfc && e->dialect == CLASSIC_NUMERIC)
		out_refuse(e, DIAG_EXPORT_SFC, "%s", project_text(e->project, pou->name));
	else if (pou->sfc)
		leave_sfc(e, pou, (*page)++);
	else if (pou->language == LANGUAGE_IL || pou->language == LANGUAGE_ST || pou->fbd)
		out_refuse(e, DIAG_EXPORT_POU, "%s", project_text(e->project, pou->name));
	else
		leave_ladder(e, pou);
}

static void leave_all(struct leaving *e)
{
	const struct pou **pou = arena_alloc(e->arena, sizeof(*pou) *
		((size_t)e->project->pou_count + 1));
	int count, page = 0;

	e->routine = arena_alloc(e->arena, sizeof(*e->routine) *
				 ((size_t)e->project->pou_count + 1));
	if (!pou || !e->routine)
		return;
	count = all_pous(e, pou);
	for (int i = 0; i < count; i++)
		if (pou[i]->kind == POU_SUBROUTINE)
			e->routine[e->routines++] = pou[i];
	for (int i = 0; i < count && e->good; i++)
		if (pou[i]->sfc)
			sfc_prepare(e, pou[i], page++);
	if (page > 5)
		out_refuse(e, DIAG_EXPORT_MANY, "%d", page);
	if (!e->good || !names_prepare(e))
		return;
	blocks_prepare(e);
	leave_initial(e);
	page = 0;
	for (int i = 0; i < count && e->good; i++)
		leave_pou(e, pou[i], &page);
	e->pou = NULL;
	leave_started(e);
}

/* ---- all of it ---- */

/* A bare rung file holds one section, and no blocks but old timers. */
static void check_numeric(struct leaving *e)
{
	const struct classic_project *out = e->out;

	e->pou = NULL;
	if (out->sections > 1)
		out_refuse(e, DIAG_EXPORT_NUMERIC, "%s", out->section[1].name);
	for (int i = 0; i < out->rungs * CLASSIC_ROWS * CLASSIC_COLUMNS && e->good; i++) {
		int at = i % (CLASSIC_ROWS * CLASSIC_COLUMNS);
		const struct classic_cell *cell = &out->rung[i / (CLASSIC_ROWS *
			CLASSIC_COLUMNS)]->cell[at / CLASSIC_COLUMNS][at % CLASSIC_COLUMNS];

		if (cell->element > CL_OLD_TIMER && cell->element != CL_PART &&
		    (cell->element < CL_COIL || cell->element > CL_JUMP))
			out_refuse(e, DIAG_EXPORT_NUMERIC, "rung %d",
			       i / (CLASSIC_ROWS * CLASSIC_COLUMNS));
	}
}

static void setting(struct leaving *e, const char *key, const char *value)
{
	struct classic_setting *one = arena_push(e->arena, &e->out->setting,
						 &e->out->settings, sizeof(*one));

	if (one) {
		one->key = key;
		one->value = value;
	}
}

static void size(struct leaving *e, const char *key, int count, int usual)
{
	setting(e, key, out_text(e, "%d", count > usual ? count : usual));
}

int blocks_end(const struct classic_blocks *blocks)
{
	return blocks->count ? blocks->block[blocks->count - 1].number + 1 : 0;
}

/* The length of an array of all words, if it is less than usual. */
static int word_count(const struct leaving *e, int type, int usual)
{
	for (int i = 0; i < e->slots; i++)
		if (e->slot[i].type == type && e->slot[i].count > 1 && !e->slot[i].number &&
		    e->slot[i].count < usual)
			return e->slot[i].count;
	return usual;
}

/* ioconf.csv has 32 lines of inputs and 32 of outputs. LinuxCNC has HAL pins instead. */
static void leave_lines(struct leaving *e)
{
	enum { LINES = 32 };
	int used[2] = { 0, 0 };

	if (!e->lines || !e->lines->count)
		return;
	if (e->dialect != CLASSIC_UPSTREAM) {
		tell_line(e, 0, e->dialect == CLASSIC_LINUXCNC ?
			  REPORTED("the I/O map is not exported: LinuxCNC connects HAL pins") :
			  REPORTED("the I/O map is not exported: a bare rung file has none"));
		return;
	}
	for (int i = 0; i < e->lines->count; i++) {
		const struct classic_io *from = &e->lines->io[i];
		struct classic_io *to;

		if (used[from->output]++ == LINES) {
			out_refuse(e, DIAG_EXPORT_MANY, "%s", from->output ?
				   "lines of outputs in the I/O map" :
				   "lines of inputs in the I/O map");
			return;
		}
		to = arena_push(e->arena, &e->out->io, &e->out->ios, sizeof(*to));
		if (to)
			*to = *from;
		size_note(e, from->output ? 60 : 50, from->first + from->count - 1);
	}
}

/* A line break of a text is the two characters \n there. */
static const char *in_one_line(struct leaving *e, const char *text)
{
	char *copy = arena_alloc(e->arena, 2 * strlen(text) + 1), *to = copy;

	for (; copy && *text; text++) {
		if (*text == '\n')
			*to++ = '\\';
		*to++ = *text == '\n' ? 'n' : *text;
	}
	if (copy)
		*to = '\0';
	return copy ? copy : "";
}

static void leave_properties(struct leaving *e)
{
	for (int i = 0; i < PROPERTY_COUNT; i++) {
		const struct property_row *row = property_row(i);
		const uint32_t id = e->project->property[i];
		const int most = i == PROPERTY_DESCRIPTION ? CLASSIC_ABOUT : CLASSIC_COMMENT;
		const char *text;

		if (!id)
			continue;
		if (!row->key || e->dialect != CLASSIC_UPSTREAM) {
			tell_line(e, 0, "the project's %s is left out",
				  report_said(e->report, row->name));
			continue;
		}
		text = in_one_line(e, project_text(e->project, id));
		setting(e, row->key, text);
		if (strlen(text) > (size_t)most)
			tell_line(e, 0, "the project's %s is cut to %d bytes",
				  report_said(e->report, row->name), most);
	}
}

static void leave_settings(struct leaving *e)
{
	struct classic_project *out = e->out;

	const char *title = plain_title(e, project_text(e->project, e->project->title));

	leave_lines(e);
	setting(e, "PROJECT_NAME", title);
	if (strlen(title) > CLASSIC_COMMENT)
		tell_line(e, 0, "the project's name is cut to %d bytes", CLASSIC_COMMENT);
	leave_properties(e);
	setting(e, "PERIODIC_REFRESH", out_text(e, "%d", out->period));
	setting(e, "PERIODIC_INPUTS_REFRESH", out_text(e, "%d", e->lines &&
		e->lines->sample_ms ? e->lines->sample_ms : 10));
	setting(e, "REAL_INPUTS_OUTPUTS_ONLY_ON_TARGET", "0");
	size(e, "SIZE_NBR_RUNGS", out->rungs, 100);
	size(e, "SIZE_NBR_BITS", e->sizes[CL_BIT], 500);
	size(e, "SIZE_NBR_WORDS", e->sizes[CL_WORD], word_count(e, CL_WORD, 200));
	size(e, "SIZE_NBR_TIMERS", blocks_end(&out->timer), 10);
	size(e, "SIZE_NBR_MONOSTABLES", blocks_end(&out->monostable), 10);
	size(e, "SIZE_NBR_COUNTERS", blocks_end(&out->counter), 10);
	size(e, "SIZE_NBR_TIMERS_IEC", blocks_end(&out->iec_timer), 10);
	size(e, "SIZE_NBR_REGISTERS", blocks_end(&out->reg), 10);
	setting(e, "SIZE_REGISTER_LIST", out_text(e, "%d", out->register_list));
	size(e, "SIZE_NBR_PHYS_INPUTS", e->sizes[50], 50);
	size(e, "SIZE_NBR_PHYS_OUTPUTS", e->sizes[60], 50);
	size(e, "SIZE_NBR_ARITHM_EXPR", out->expressions, 100);
	size(e, "SIZE_NBR_SECTIONS", out->sections, 10);
	size(e, "SIZE_NBR_SYMBOLS", out->symbols, 100);
	size(e, "SIZE_NBR_PHYS_WORDS_INPUTS", e->sizes[270], word_count(e, 270, 25));
	size(e, "SIZE_NBR_PHYS_WORDS_OUTPUTS", e->sizes[280], word_count(e, 280, 25));
}

struct classic_project *to_classic(struct project *project, enum classic_dialect dialect,
				   const struct classic_lines *lines, struct arena *arena,
				   struct classic_report *report, struct diag_list *diags)
{
	struct leaving *e = arena_alloc(arena, sizeof(*e));
	int before = diags->errors;

	if (!e)
		return NULL;
	*e = (struct leaving){ .project = project, .dialect = dialect, .arena = arena,
		.columns = classic_columns(dialect), .rows = classic_rows(dialect),
		.lines = lines, .report = report, .diags = diags, .started = -1, .never = -1,
		.rung_index = -1, .good = true,
		.scope = scope_new(project, arena),
		.out = arena_alloc(arena, sizeof(struct classic_project)),
		.expr = arena_alloc(arena, sizeof(struct expr)) };
	if (e->scope && e->out && e->expr) {
		e->out->dialect = dialect;
		e->out->period = 50;
		e->out->register_list = 500;
		leave_all(e);
		if (e->good) {
			names_symbols(e);
			leave_told(e);
			leave_kept(e);
			leave_settings(e);
		}
		if (dialect == CLASSIC_NUMERIC && e->good)
			check_numeric(e);
	}
	if (!arena->failed && e->good && e->scope && e->expr)
		return e->out;
	if (diags->errors == before)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
					       .file = project->file }, "%s", "");
	return NULL;
}

/* The rung that a jump leads to; -1: none. */
static int target_of(const struct leaving *e, const struct pou *pou, uint32_t label)
{
	const struct names *names = &e->project->names;

	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    names_fold(names, pou->rung[i]->label) == names_fold(names, label))
			return i;
	return -1;
}

static bool in_loop(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = index; i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; k < rung->rows * rung->cols; k++) {
			int to = rung->cell[k].word == ELEM_JUMP && !rung->off ?
				 target_of(e, pou, rung->cell[k].operand) : -1;

			if (to >= 0 && to <= index)
				return true;
		}
	}
	return false;
}

struct call_place { const struct pou *pou; int rung, count; };

static void find_calls(const struct leaving *e, const struct pou *called,
		       struct call_place *place)
{
	*place = (struct call_place){ NULL, 0, 0 };
	for (int i = 0; i < e->project->pou_count; i++) {
		const struct pou *pou = &e->project->pou[i];

		for (int k = 0; k < pou->rung_count; k++)
			for (int m = 0; m < pou->rung[k]->rows * pou->rung[k]->cols; m++) {
				const struct cell *cell = &pou->rung[k]->cell[m];

				if (cell->word == ELEM_CALL && !pou->rung[k]->off &&
				    scope_pou(e->scope, pou, cell->operand) == called)
					*place = (struct call_place){ pou, k,
						place->count + 1 };
			}
	}
}

/* Can a rung before @index jump past it? */
static bool is_skipped(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = 0; i < index; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; !rung->off && k < rung->rows * rung->cols; k++) {
			const struct cell *cell = &rung->cell[k];

			if (cell->word == ELEM_RETURN || cell->word == ELEM_END ||
			    (cell->word == ELEM_JUMP &&
			     target_of(e, pou, cell->operand) > index))
				return true;
		}
	}
	return false;
}

bool may_rest(struct leaving *e)
{
	return e->pou->kind == POU_SUBROUTINE || is_skipped(e, e->pou, e->rung_index);
}

bool runs_often(struct leaving *e)
{
	const struct pou *pou = e->pou;
	int rung = e->rung_index;

	for (int depth = 0; depth <= e->project->pou_count; depth++) {
		struct call_place place;

		if (in_loop(e, pou, rung))
			return true;
		if (pou->kind != POU_SUBROUTINE)
			return false;
		find_calls(e, pou, &place);
		if (place.count != 1)
			return place.count > 1;
		pou = place.pou;
		rung = place.rung;
	}
	return true;
}

static bool overlap(struct iec_addr a, int64_t bits, struct iec_addr b, int64_t more)
{
	int64_t from = (int64_t)a.byte * 8 + a.bit, to = (int64_t)b.byte * 8 + b.bit;

	return a.area == b.area && from < to + more && to < from + bits;
}

static int64_t bits_of(const struct var *var)
{
	return (int64_t)var->at.bits * (var->array.count ? var->array.count : 1);
}

static bool table_shares(const struct var_table *table, const struct var *var)
{
	for (int i = 0; i < table->count; i++)
		if (&table->var[i] != var && table->var[i].at.area != AREA_NONE &&
		    overlap(var->at, bits_of(var), table->var[i].at,
			    bits_of(&table->var[i])))
			return true;
	return false;
}

bool is_shared(struct leaving *e, const struct var *var)
{
	const struct names *names = &e->project->names;

	for (uint32_t id = 1; id < (uint32_t)names->count; id++) {
		const char *text = names_text(names, id);
		struct iec_addr addr;

		if (id != var->at_text && iec_addr_parse(text, strlen(text), &addr) == ADDR_OK &&
		    overlap(var->at, bits_of(var), addr, addr.bits) &&
		    memcmp(&addr, &var->at, sizeof(addr)) != 0)
			return true;
	}
	if (table_shares(&e->project->globals, var))
		return true;
	for (int i = 0; i < e->project->pou_count; i++)
		if (table_shares(&e->project->pou[i].vars, var))
			return true;
	return false;
}
