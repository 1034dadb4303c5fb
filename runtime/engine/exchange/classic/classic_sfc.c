/* SPDX-License-Identifier: MIT
 *
 * classic_sfc - a sequential page as a chart IN ORDER, which is how ClassicLadder runs it.
 *
 * In ClassicLadder each page sets %X of all pages when it ends. Here each chart sets %X of
 * its own steps, and extra actions set what can be read in the first scan before that. The
 * seconds of a step (%X3.V) come from a CL_STEP in an action; they include the scan in which
 * the step became active.
 */
#include "engine/exchange/classic/classic_convert.h"

#include <limits.h>
#include <string.h>

static bool on_page(const struct classic_section *section, int page)
{
	return section->page == page;
}

/* Index of the first section that is a page; -1: there is none. */
static int first_page(const struct conversion *c)
{
	for (int i = 0; i < c->project->sections; i++)
		if (c->project->section[i].sequential)
			return i;
	return -1;
}

/* The first section that shows @page; INT_MAX: none, so the page never runs. */
static int section_of(const struct conversion *c, int page)
{
	for (int i = 0; i < c->project->sections; i++)
		if (c->project->section[i].sequential &&
		    on_page(&c->project->section[i], page))
			return i;
	return INT_MAX;
}

static bool is_first(const struct conversion *c, const struct classic_section *section)
{
	return section - c->project->section == first_page(c);
}

/* ---- readers of %X3.A ---- */

/* By number of a step: does the first page or a section before it read %X; the first section
 * behind that one that reads it. Sub-routines count as called from anywhere. */
struct readers {
	bool before[CLASSIC_LIMIT + 1];
	int behind[CLASSIC_LIMIT + 1];
	int section, first;
	bool anywhere;
};

static void read_step(struct readers *r, int type, int number)
{
	if (type != STEP_TYPE || number < 0 || number > CLASSIC_LIMIT)
		return;
	if (r->anywhere || r->section <= r->first)
		r->before[number] = true;
	if (r->anywhere)
		r->behind[number] = 0;
	else if (r->section > r->first && r->section < r->behind[number])
		r->behind[number] = r->section;
}

static void read_variable(void *context, struct classic_variable variable)
{
	read_step(context, variable.type, variable.number);
	read_step(context, variable.index_type, variable.index_number);
}

static void read_rung(const struct conversion *c, struct readers *r,
		      const struct classic_rung *rung)
{
	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x < CLASSIC_COLUMNS; x++) {
			const struct classic_cell *cell = &rung->cell[y][x];
			const char *text = cell->element == 20 || cell->element == 60 ?
				classic_expression(c->project, cell->variable.number) :
				NULL;

			read_variable(r, cell->variable);
			if (text)
				expression_uses(text, read_variable, r);
		}
}

static void read_section(const struct conversion *c, struct readers *r)
{
	const struct classic_project *project = c->project;
	const struct classic_section *section = &project->section[r->section];
	const struct classic_rung *rung = section->sequential ? NULL :
					  classic_rung(project, section->first);

	for (int i = 0; section->sequential && i < project->transitions; i++)
		if (on_page(section, project->transition[i].page))
			read_variable(r, project->transition[i].condition);
	for (int i = 0; rung && i < project->rungs; i++) {
		read_rung(c, r, rung);
		if (rung->number == section->last || rung->next < 0)
			return;
		rung = classic_rung(project, rung->next);
	}
}

static struct readers *find_readers(const struct conversion *c)
{
	struct readers *r = arena_alloc(c->arena, sizeof(*r));

	if (!r)
		return NULL;
	r->first = first_page(c);
	for (int i = 0; i <= CLASSIC_LIMIT; i++)
		r->behind[i] = INT_MAX;
	for (r->section = 0; r->section < c->project->sections; r->section++) {
		r->anywhere = c->project->section[r->section].subroutine >= 0;
		read_section(c, r);
	}
	return r;
}

/* ---- steps ---- */

/* In ClassicLadder the page that runs first sets %X of initial steps of other pages. Can that
 * be read before their own chart sets it? */
static bool begins(struct conversion *c, const struct readers *r,
		   const struct classic_step *step)
{
	const int own = section_of(c, step->page);

	return step->initial && r->first >= 0 && own != r->first &&
	       (own == INT_MAX || r->behind[step->number] <= own ||
		(c->options.faithful && time_is_used(c, step->number)));
}

static void find_steps(struct conversion *c)
{
	const struct classic_project *project = c->project;
	const struct readers *r;
	bool *taken;

	if (c->step)
		return;
	c->step = arena_alloc(c->arena, ((size_t)project->steps + 1) * sizeof(*c->step));
	taken = arena_alloc(c->arena, CLASSIC_LIMIT + 1);
	r = find_readers(c);
	for (int i = project->steps - 1; c->step && taken && r && i >= 0; i--) {
		const struct classic_step *step = &project->step[i];

		c->step[i].publishes = !taken[step->number];
		taken[step->number] = true;
		c->step[i].begins = c->step[i].publishes && begins(c, r, step);
		c->step[i].late = c->step[i].begins && r->before[step->number];
	}
	for (int i = 0; c->step && i < project->steps; i++) {
		const char *name = text_of(c, "Step%d", project->step[i].number);

		c->step[i].name = c->step[i].publishes ? name : name_new(c, name);
	}
}

static struct sfc_step here_of(struct conversion *c, const struct classic_step *step)
{
	find_steps(c);
	return c->step ? c->step[step - c->project->step] :
			 (struct sfc_step){ .name = "" };
}

bool step_begins(struct conversion *c, int number)
{
	for (int i = 0; i < c->project->steps; i++)
		if (c->project->step[i].number == number) {
			const struct sfc_step here = here_of(c, &c->project->step[i]);

			if (here.begins)
				return !here.late;
		}
	return false;
}

static const struct classic_step *step_at(const struct conversion *c, int index)
{
	for (int i = 0; i < c->project->steps; i++)
		if (c->project->step[i].index == index)
			return &c->project->step[i];
	return NULL;
}

/* With --faithful, pages that ran before have already counted the time of an initial step:
 * it starts again only after the step was left. */
static bool has_counted(const struct conversion *c, const struct classic_section *section,
			const struct classic_step *step)
{
	return c->options.faithful && step->initial && !is_first(c, section);
}

/* %X3.A is the state at the end of the evolution: a BOOL that the step holds. If it is TRUE
 * before the chart runs, an action with P1 also clears it when the step is left in its first
 * scan. */
static void write_step(struct conversion *c, const struct classic_section *section,
		       const struct classic_step *step)
{
	const struct sfc_step here = here_of(c, step);
	const int number = step->number;
	const char *x = step_of(c, number);

	c->at = step->place;
	put(c, "  %s %s (COLUMN := %d):\n", step->initial ? "INITIAL_STEP" : "STEP",
	    here.name, step->x < 0 ? 1 : step->x + 1);
	if (here.begins)
		put(c, "    Tell%d(N);\n    Tell%d(P1);\n", number, number);
	else if (here.publishes)
		put(c, "    %s(N);\n", x);
	if (here.publishes && time_is_used(c, number)) {
		put(c, "    Seconds%d(N);\n", number);
		if (has_counted(c, section, step))
			put(c, "    Anew%d(P0);\n", number);
	}
	put(c, "  END_STEP\n\n");
	if (!here.publishes)
		tell(c, REPORT_TAKEN, "%%X%d is that of another step with this number",
		     number);
}

static void write_actions(struct conversion *c, const struct classic_section *section,
			  const struct classic_step *step)
{
	const struct sfc_step here = here_of(c, step);
	const char *x = step_of(c, step->number);

	c->at = step->place;
	if (here.begins)
		put(c, "  ACTION Tell%d:\n    RUNG\n      | NO %s.X | COIL %s |\n"
		    "  END_ACTION\n\n", step->number, here.name, x);
	if (!here.publishes || !time_is_used(c, step->number))
		return;
	if (has_counted(c, section, step))
		put(c, "  ACTION Anew%d:\n    RUNG\n      | NC SYS_ALWAYS_ON | CL_STEP XTime%d "
		    "T:=T#0s DT:=SYS_CYCLE |\n  END_ACTION\n\n", step->number,
		    step->number);
	put(c, "  ACTION Seconds%d:\n    RUNG\n      | NO %s.X | CL_STEP XTime%d T:=%s.T "
	    "%sDT:=SYS_CYCLE |\n  END_ACTION\n\n", step->number, here.name, step->number,
	    here.name, has_counted(c, section, step) ? "KEEP:=SYS_FIRST_SCAN " : "");
}

/* ---- transitions ---- */

static bool is_again(const int *index, int at)
{
	for (int i = 0; i < at; i++)
		if (index[i] == index[at])
			return true;
	return false;
}

/* " FROM Idle", " TO (Fill, Stir)"; "": no step. */
static const char *step_list(struct conversion *c, const char *word,
			     const struct classic_section *section, const int *index,
			     int count)
{
	const char *list = NULL;
	int found = 0;

	for (int i = 0; i < count; i++) {
		const struct classic_step *step = step_at(c, index[i]);

		if (!step || is_again(index, i))
			continue;
		if (!on_page(section, step->page)) {
			tell(c, REPORT_LOST, "a step of another page");
			continue;
		}
		list = found++ ? text_of(c, "%s, %s", list, here_of(c, step).name) :
				 here_of(c, step).name;
	}
	return found > 1 ? text_of(c, " %s (%s)", word, list) :
	       found ? text_of(c, " %s %s", word, list) : "";
}

static void write_transition(struct conversion *c, const struct classic_section *section,
			     const struct classic_transition *transition)
{
	const char *from, *to, *condition = "FALSE";
	bool is_bool = true;

	c->at = transition->place;
	from = step_list(c, "FROM", section, transition->deactivate,
			 transition->deactivates);
	to = step_list(c, "TO", section, transition->activate, transition->activates);
	if (!*from && !*to) {
		tell(c, REPORT_LOST, "a transition without any step");
		return;
	}
	if (transition->condition.type >= 0)
		condition = operand_of(c, transition->condition, &is_bool);
	else
		tell(c, REPORT_TAKEN, "a transition without a condition never fires");
	put(c, "  TRANSITION%s%s := %s%s; END_TRANSITION\n\n", from, to,
	    condition ? condition : "FALSE", is_bool ? "" : " <> 0");
}

static void write_notes(struct conversion *c, const struct classic_section *section)
{
	for (int i = 0; i < c->project->notes; i++) {
		const struct classic_note *note = &c->project->note[i];

		c->at = note->place;
		if (on_page(section, note->page) && note->text[0])
			put_comment_line(c, "  ", note->text);
	}
}

static bool has_steps(const struct conversion *c, const struct classic_section *section)
{
	for (int i = 0; i < c->project->steps; i++)
		if (on_page(section, c->project->step[i].page))
			return true;
	return false;
}

/* False without an initial step and without a transition from no step. */
static bool ever_runs(const struct conversion *c, const struct classic_section *section)
{
	const struct classic_project *project = c->project;

	for (int i = 0; i < project->steps; i++)
		if (on_page(section, project->step[i].page) && project->step[i].initial)
			return true;
	for (int i = 0; i < project->transitions; i++)
		if (on_page(section, project->transition[i].page) &&
		    !project->transition[i].deactivates)
			return true;
	return false;
}

static void write_one_sfc(struct conversion *c, const struct classic_section *section)
{
	const struct classic_project *project = c->project;

	add_program(c, c->section_pou);
	put(c, "PROGRAM %s SFC IN ORDER\n", c->section_pou);
	for (int i = 0; i < project->steps; i++)
		if (on_page(section, project->step[i].page))
			write_step(c, section, &project->step[i]);
	for (int i = 0; i < project->transitions; i++)
		if (on_page(section, project->transition[i].page))
			write_transition(c, section, &project->transition[i]);
	for (int i = 0; i < project->steps; i++)
		if (on_page(section, project->step[i].page))
			write_actions(c, section, &project->step[i]);
	write_notes(c, section);
	c->at = section->place;
	put(c, "END_PROGRAM\n\n");
}

/* ---- steps of other pages ---- */

static void begin_more(struct conversion *c, const char **name)
{
	if (*name)
		return;
	*name = name_new(c, text_of(c, "%s_Others", c->section_pou));
	add_program(c, *name);
	put(c, "PROGRAM %s LD\n", *name);
}

/* A program behind the page: it sets %X of late steps in the first scan. With --faithful it
 * also advances the time of steps of other pages, as ClassicLadder does. */
static void convert_others(struct conversion *c, const struct classic_section *section)
{
	const char *name = NULL;

	for (int i = 0; i < c->project->steps; i++) {
		const struct classic_step *step = &c->project->step[i];
		const struct sfc_step here = here_of(c, step);
		int number = step->number;

		if (on_page(section, step->page) || !here.publishes)
			continue;
		if (here.late && is_first(c, section)) {
			begin_more(c, &name);
			put(c, "RUNG\n  | NO SYS_FIRST_SCAN | S %s |\n", step_of(c, number));
		}
		if (!c->options.faithful || !time_is_used(c, number))
			continue;
		begin_more(c, &name);
		put(c, "RUNG\n  | NO %s | CL_STEP XTime%d T:=T#1s DT:=SYS_CYCLE |\n",
		    step_of(c, number), number);
	}
	if (name)
		put(c, "END_PROGRAM\n\n");
}

void report_pages(struct conversion *c)
{
	const struct classic_project *project = c->project;

	for (int i = 0; i < project->steps + project->transitions; i++) {
		const struct classic_step *step = i < project->steps ? &project->step[i] : NULL;
		const struct classic_transition *transition =
			step ? NULL : &project->transition[i - project->steps];
		const int page = step ? step->page : transition->page;

		c->at = step ? step->place : transition->place;
		if (section_of(c, page) == INT_MAX)
			tell(c, REPORT_LOST, step ? REPORTED("step %d: no section shows page %d") :
			     REPORTED("transition %d: no section shows page %d"),
			     step ? step->number : transition->index, page);
	}
}

/* Transitions of a page that has nothing else. */
static void report_transitions(struct conversion *c, const struct classic_section *section)
{
	for (int i = 0; i < c->project->transitions; i++) {
		const struct classic_transition *transition = &c->project->transition[i];

		c->at = transition->place;
		if (on_page(section, transition->page))
			tell(c, REPORT_LOST, "transition %d: page %d has no steps",
			     transition->index, transition->page);
	}
}

void convert_sfc(struct conversion *c, const struct classic_section *section)
{
	if (!has_steps(c, section))
		report_transitions(c, section);
	else if (!ever_runs(c, section))
		tell(c, REPORT_LOST, "section \"%s\" is a page without an initial step: "
		     "nothing happens on it", section->name);
	else
		write_one_sfc(c, section);
	if (section->subroutine >= 0)
		tell(c, REPORT_CHANGED, "a page is no subroutine: it runs in each scan");
	convert_others(c, section);
}
