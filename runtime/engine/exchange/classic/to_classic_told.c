/* SPDX-License-Identifier: MIT
 *
 * to_classic_told - reports what an export leaves out or what changes its meaning in
 * ClassicLadder: variables, comments, configuration, POUs.
 *
 * Changes inside rungs are reported where the rung is written.
 */
#include "engine/exchange/classic/to_classic_parts.h"

/* ---- variables ---- */

static void told_flags(struct leaving *e, const struct var *var, uint16_t flags)
{
	const char *name = project_text(e->project, var->name);

	if (flags & VAR_RETAIN)
		tell_line(e, var->line, "%s: ClassicLadder retains no values", name);
}

static bool is_narrow(enum iec_type type)
{
	return type == IEC_SINT || type == IEC_INT || type == IEC_USINT || type == IEC_UINT ||
	       type == IEC_BYTE || type == IEC_WORD;
}

/* Is the variable exported? A TIME is, if it is the preset of a timer. */
static bool is_expressed(const struct out_slot *slot)
{
	if (slot->block >= 0 || slot->type >= 0 || slot->calls)
		return true;
	return slot->var->type == IEC_NONE && slot->extra[0] >= 0;
}

static void told_variable(struct leaving *e, const struct var *var, uint16_t flags)
{
	const struct out_slot *slot = slot_find(e, var);
	const char *name = project_text(e->project, var->name);

	if (flags & VAR_SFC)
		return;
	told_flags(e, var, flags);
	if (!slot || !is_expressed(slot))
		tell_line(e, var->line, "%s is not exported: nothing needs it", name);
	else if (slot->block < 0 && is_narrow(var->type))
		tell_line(e, var->line, "%s has 32 bits in ClassicLadder, more than %s has", name,
			  iec_type_row(var->type)->word);
	if (slot && slot->type >= 0 && slot->block < 0 && var->array.count)
		tell_line(e, var->line, "%s: ClassicLadder has no names for arrays", name);
}

static void told_table(struct leaving *e, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++)
		told_variable(e, &table->var[i], vars_flags(table, i));
}

/* ---- comments ---- */

struct comments { int count, line; };

static void note_comment(struct comments *comments, uint32_t text, int line)
{
	if (!text)
		return;
	if (!comments->count++ || line < comments->line)
		comments->line = line;
}

static void rung_comments(const struct rung *rung, struct comments *comments)
{
	note_comment(comments, rung->comment, rung_line(rung, 0));
	for (int i = 0; i < rung->rows * rung->cols; i++)
		note_comment(comments, rung->cell[i].comment,
			     rung_line(rung, i / rung->cols + 1));
}

/* Comments of arrays, and of variables without a symbol. */
static void table_comments(struct leaving *e, const struct var_table *table,
			   struct comments *comments)
{
	for (int i = 0; i < table->block_count; i++)
		note_comment(comments, table->block[i].comment, table->block[i].line);
	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		const struct out_slot *slot = slot_find(e, var);

		if (!slot || var->array.count || (slot->type < 0 && slot->block < 0))
			note_comment(comments, var->comment, var->line);
	}
}

static void told_comments(struct leaving *e)
{
	const struct project *project = e->project;
	struct comments comments = { 0, 0 };

	note_comment(&comments, project->head, 1);
	note_comment(&comments, project->tail, 1);
	table_comments(e, &project->globals, &comments);
	for (int i = 0; i < project->part_count; i++)
		note_comment(&comments, project->part[i].comment, 1);
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		note_comment(&comments, pou->comment, pou->line);
		note_comment(&comments, pou->tail, pou->line);
		table_comments(e, &pou->vars, &comments);
		for (int k = 0; k < pou->rung_count; k++)
			rung_comments(pou->rung[k], &comments);
	}
	if (comments.count)
		tell_line(e, comments.line, comments.count > 1 ?
			  REPORTED("%d comments are not exported: ClassicLadder has them on rungs, "
			       "as their titles, and on symbols") :
			  REPORTED("%d comment is not exported: ClassicLadder has them on rungs, "
			       "as their titles, and on symbols"), comments.count);
}

/* ---- the configuration ---- */

static bool runs(const struct leaving *e, const struct pou *pou)
{
	const struct config *config = e->project->config;
	bool any = false;

	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_PROGRAM) {
			any = true;
			if (names_fold(&e->project->names, config->entry[i].pou) ==
			    names_fold(&e->project->names, pou->name))
				return true;
		}
	return !any;
}

static void told_entry(struct leaving *e, const struct config_entry *entry)
{
	const char *name = project_text(e->project, entry->name);

	if (entry->kind == CONFIG_TASK && entry->watchdog_ns)
		tell_line(e, entry->line, "%s: ClassicLadder does not monitor the length of a scan",
			  name);
	if (entry->kind == CONFIG_TASK && entry->interval_ns % 1000000)
		tell_line(e, entry->line, "%s: ClassicLadder needs whole milliseconds; it "
			  "uses %d ms", name,
			  e->out->period);
	if (entry->kind == CONFIG_AREA)
		tell_line(e, entry->line, "AREA: ClassicLadder has its own area sizes");
}

static void told_config(struct leaving *e)
{
	const struct config *config = e->project->config;

	for (int i = 0; config && i < config->count; i++)
		told_entry(e, &config->entry[i]);
	if (!e->has_period && e->dialect != CLASSIC_NUMERIC)
		tell_line(e, config ? config->line : 0, "no task gives the period: "
			  "ClassicLadder uses %d ms", e->out->period);
}

/* ---- POUs and the rest ---- */

static void told_pous(struct leaving *e)
{
	const struct project *project = e->project;

	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];
		const char *name = project_text(project, pou->name);

		if (pou_has_frame(pou)) {
			if (!pou_is_imported(project, pou))
				tell_line(e, pou->line, "%s %s is not exported",
					  pou_word(pou->kind), name);
			continue;
		}
		told_table(e, &pou->vars);
		if (pou->kind == POU_PROGRAM && !runs(e, pou))
			tell_line(e, pou->line, "PROGRAM %s is not exported: no task runs it",
				  name);
	}
	for (int i = 0; i < project->structure_count; i++)
		if (project->structure[i].name)
			tell_line(e, project->structure[i].line, "structure %s is not exported",
				  project_text(project, project->structure[i].name));
}

/* LinuxCNC takes sizes from the line that loads its module. */
static void told_sizes(struct leaving *e)
{
	const struct { const char *name; int count, usual; } row[] = {
		{ "numRungs", e->out->rungs, 100 }, { "numBits", e->sizes[CL_BIT], 20 },
		{ "numWords", e->sizes[CL_WORD], 20 },
		{ "numTimers", blocks_end(&e->out->timer), 10 },
		{ "numMonostables", blocks_end(&e->out->monostable), 10 },
		{ "numCounters", blocks_end(&e->out->counter), 10 },
		{ "numTimersIec", blocks_end(&e->out->iec_timer), 10 },
		{ "numPhysInputs", e->sizes[50], 15 }, { "numPhysOutputs", e->sizes[60], 15 },
		{ "numArithmExpr", e->out->expressions, 100 },
		{ "numSections", e->out->sections, 10 },
		{ "numS32in", e->sizes[270], 10 }, { "numS32out", e->sizes[280], 10 },
	};
	const char *text = "";

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++)
		if (row[i].count > row[i].usual)
			text = out_text(e, "%s %s=%d", text, row[i].name, row[i].count);
	if (e->dialect == CLASSIC_LINUXCNC && *text)
		tell_line(e, 0, "load classicladder_rt with%s", text);
}

static const int base_ms[] = { 60000, 1000, 100 };

/* Faults of ClassicLadder that an import repairs. */
static void told_faults(struct leaving *e)
{
	const struct classic_blocks *mono = &e->out->monostable, *iec = &e->out->iec_timer;
	const int period = e->out->period;

	for (int i = 0; i < mono->count; i++)
		if (mono->block[i].preset * base_ms[mono->block[i].base] % period)
			tell_line(e, 0, "monostable %%M%d works only once in ClassicLadder: its "
				  "time is no multiple of %d ms", mono->block[i].number, period);
	for (int i = 0; i < iec->count; i++)
		if (base_ms[iec->block[i].base] < period)
			tell_line(e, 0, "timer %%TM%d is slow in ClassicLadder: it counts one "
				  "unit a scan", iec->block[i].number);
	if (iec->count)
		tell_line(e, 0, "in ClassicLadder, timers (%%TM) that are cut short keep the "
			  "part of a unit they had");
	if (e->out->reg.count)
		tell_line(e, 0, "in ClassicLadder, registers (%%R) use one more place than they "
			  "have");
	if (e->divides)
		tell_line(e, 0, e->dialect == CLASSIC_LINUXCNC ?
			  REPORTED("a division by 0 ends LinuxCNC's real-time part") :
			  REPORTED("a division by 0 gives 0 in ClassicLadder, and the rung goes on"));
	if (e->sums)
		tell_line(e, 0, "arithmetic that overflows wraps in ClassicLadder; here it is an "
			  "error");
	if (e->indexes)
		tell_line(e, 0, "an index outside its array reads and writes other "
			  "variables in ClassicLadder");
	if (e->clocks)
		tell_line(e, 0, "in ClassicLadder, SYS_CLOCK_1S and SYS_CLOCK_1MIN begin with "
			  "the machine's second and minute");
}

void leave_told(struct leaving *e)
{
	e->pou = NULL;
	told_table(e, &e->project->globals);
	told_pous(e);
	told_comments(e);
	told_config(e);
	told_sizes(e);
	told_faults(e);
}
