/* SPDX-License-Identifier: MIT
 *
 * to_classic - sections and settings of an export to ClassicLadder, and the order of programs.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include <string.h>

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

