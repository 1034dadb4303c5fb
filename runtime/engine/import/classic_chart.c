/* SPDX-License-Identifier: MIT
 *
 * classic_chart - a sequential page as a chart that runs until it is stable.
 *
 * There, transitions fire in the order of their numbers: here that is their priority. The
 * seconds of a step (%X3.V), which count the scan in which it became active, are those of
 * a CL_STEP in an action of it.
 */
#include "engine/import/classic_convert.h"

#include <string.h>

static bool on_page(const struct classic_section *section, int page)
{
	return section->page == page;
}

static bool is_first(const struct conversion *c, const struct classic_section *section)
{
	for (int i = 0; i < c->project->sections; i++)
		if (c->project->section[i].sequential)
			return &c->project->section[i] == section;
	return false;
}

static const struct classic_step *step_at(const struct conversion *c, int index)
{
	for (int i = 0; i < c->project->steps; i++)
		if (c->project->step[i].index == index)
			return &c->project->step[i];
	return NULL;
}

static const char *chart_step(struct conversion *c, const struct classic_step *step)
{
	return text_of(c, "Step%d", step->number);
}

/* %X3.A is what it was when the chart came to rest: an action of the step, not its state. */
static void write_step(struct conversion *c, const struct classic_step *step)
{
	int number = step->number;

	c->at = step->place;
	put(c, "  %s %s (COLUMN := %d):\n    %s(N);\n",
	    step->initial ? "INITIAL_STEP" : "STEP", chart_step(c, step),
	    step->x < 0 ? 1 : step->x + 1, step_of(c, number));
	if (time_is_used(c, number))
		put(c, "    Seconds%d(N);\n", number);
	put(c, "  END_STEP\n\n");
}

static void write_seconds(struct conversion *c, const struct classic_section *section,
			  const struct classic_step *step)
{
	const char *name = chart_step(c, step);
	/* Pages before this one have counted already. */
	bool counted = c->options.faithful && step->initial && !is_first(c, section);

	if (!time_is_used(c, step->number))
		return;
	c->at = step->place;
	put(c, "  ACTION Seconds%d:\n    RUNG\n      | NO %s.X | CL_STEP XTime%d T:=%s.T "
	    "%sDT:=SYS_CYCLE |\n  END_ACTION\n\n", step->number, name, step->number, name,
	    counted ? "KEEP:=SYS_FIRST_SCAN " : "");
}

/* "Idle" or "(Fill, Stir)"; NULL: none of them is there. */
static const char *step_list(struct conversion *c, const int *index, int count)
{
	const char *list = NULL;
	int found = 0;

	for (int i = 0; i < count; i++) {
		const struct classic_step *step = step_at(c, index[i]);

		if (!step)
			continue;
		list = found++ ? text_of(c, "%s, %s", list, chart_step(c, step)) :
				 chart_step(c, step);
	}
	return found > 1 ? text_of(c, "(%s)", list) : list;
}

static void write_transition(struct conversion *c,
			     const struct classic_transition *transition)
{
	const char *from = step_list(c, transition->deactivate, transition->deactivates);
	const char *to = step_list(c, transition->activate, transition->activates);
	const char *condition = "FALSE";
	bool is_bool = true;

	c->at = transition->place;
	if (!from || !to) {
		tell(c, REPORT_LOST, "a transition without a step %s it",
		     from ? "behind" : "before");
		return;
	}
	if (transition->condition.type >= 0)
		condition = operand_of(c, transition->condition, &is_bool);
	else
		tell(c, REPORT_CHANGED, "a transition without a condition never fires");
	put(c, "  TRANSITION FROM %s TO %s := %s%s; END_TRANSITION\n\n", from, to,
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

/* What the first page said of this one's steps (see below) ends: they speak themselves. */
static void begin_later(struct conversion *c, const struct classic_section *section)
{
	const char *name = NULL;

	for (int i = 0; i < c->project->steps && !is_first(c, section); i++) {
		const struct classic_step *step = &c->project->step[i];

		if (!on_page(section, step->page) || !step->initial)
			continue;
		if (!name) {
			name = name_new(c, text_of(c, "%s_Begin", c->section_pou));
			add_program(c, name);
			put(c, "PROGRAM %s LD\n", name);
		}
		put(c, "RUNG\n  | NO SYS_FIRST_SCAN | R %s |\n", step_of(c, step->number));
	}
	if (name)
		put(c, "END_PROGRAM\n\n");
}

void convert_chart(struct conversion *c, const struct classic_section *section)
{
	const struct classic_project *project = c->project;

	if (!has_steps(c, section)) {
		tell(c, REPORT_LOST, "section \"%s\" is an empty page", section->name);
		return;
	}
	if (section->subroutine >= 0)
		tell(c, REPORT_CHANGED, "a page is no subroutine: it runs in each scan");
	begin_later(c, section);
	add_program(c, c->section_pou);
	put(c, "PROGRAM %s SFC UNTIL STABLE\n", c->section_pou);
	for (int i = 0; i < project->steps; i++)
		if (on_page(section, project->step[i].page))
			write_step(c, &project->step[i]);
	for (int i = 0; i < project->transitions; i++)
		if (on_page(section, project->transition[i].page))
			write_transition(c, &project->transition[i]);
	for (int i = 0; i < project->steps; i++)
		if (on_page(section, project->step[i].page))
			write_seconds(c, section, &project->step[i]);
	write_notes(c, section);
	c->at = section->place;
	put(c, "END_PROGRAM\n\n");
	convert_others(c, section);
}

/* ---- what a page does for the others ---- */

static void begin_more(struct conversion *c, const char **name)
{
	if (*name)
		return;
	*name = name_new(c, text_of(c, "%s_Others", c->section_pou));
	add_program(c, *name);
	put(c, "PROGRAM %s LD\n", *name);
}

/* When one page has run, the bits of all steps are what they are: in the first scan those
 * of pages that have not run yet, too. And, a fault of the original, each page lets the
 * time of all steps go on. */
void convert_others(struct conversion *c, const struct classic_section *section)
{
	const char *name = NULL;

	for (int i = 0; i < c->project->steps; i++) {
		const struct classic_step *step = &c->project->step[i];
		int number = step->number;

		if (on_page(section, step->page))
			continue;
		if (step->initial && is_first(c, section)) {
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
