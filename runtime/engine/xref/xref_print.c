/* SPDX-License-Identifier: MIT
 *
 * xref_print - prints uses as lines for people and as JSON, sorted by thing.
 */
#include "engine/base/name.h"
#include "engine/xref/xref.h"


#include <stdio.h>
#include <string.h>

static const char *const kind_words[XREF_KINDS] = {
	[XREF_DECLARED] = "declared", [XREF_TYPE] = "type", [XREF_READ] = "read",
	[XREF_WRITTEN] = "written", [XREF_CHANGED] = "changed", [XREF_COIL] = "coil",
	[XREF_SET] = "set", [XREF_RESET] = "reset", [XREF_CALLED] = "called",
	[XREF_JUMPED] = "jumped to", [XREF_RUN] = "run",
	[XREF_LEFT] = "left", [XREF_ENTERED] = "entered",
	[XREF_INITIAL] = "initial",
};

const char *xref_text(const struct xref *xref, const struct xref_use *use)
{
	return use->slot ? project_text(xref->project, *use->slot) : "";
}

/* ---- names ---- */

/* The name in front of those of a table; "": the globals. */
static const char *table_name(const struct project *project, int table)
{
	if (table == 0)
		return "";
	if (table <= project->pou_count)
		return project_text(project, project->pou[table - 1].name);
	table -= project->pou_count + 1;
	if (table < project->structure_count && !project->structure[table].name)
		return "STRUCT";
	return project_text(project, table < project->structure_count ?
		project->structure[table].name :
		project->named[table - project->structure_count].name);
}

/* Color#Red, Main.Door#Open. */
static int value_name(const struct project *project, int value, char *out, size_t size)
{
	const char *name = project_text(project, project->enum_value[value].name);
	int table, index;

	if (!xref_value_owner(project, value, &table, &index))
		return snprintf(out, size, "%s", name);
	if (table > project->pou_count + project->structure_count)
		return snprintf(out, size, "%s#%s", table_name(project, table), name);
	return snprintf(out, size, "%s%s%s#%s", table_name(project, table), table ? "." : "",
			project_text(project, xref_table((struct project *)(uintptr_t)project,
							 table)->var[index].name), name);
}

/* The name in the text of the use, for undeclared things. */
static int written_name(const struct project *project, const struct xref_use *use,
			char *out, size_t size)
{
	if (!use || !use->slot)
		return snprintf(out, size, "%s", "");
	return snprintf(out, size, "%.*s", (int)use->len,
			project_text(project, *use->slot) + use->at);
}

static int label_name(const struct project *project, const struct xref_target *target,
		      const struct xref_use *use, char *out, size_t size)
{
	const struct pou *pou = &project->pou[target->table - 1];
	uint32_t name = 0;

	if (target->index >= 0)
		name = target->index < pou->rung_count ?
		       pou->rung[target->index]->label :
		       pou->il.line[target->index - pou->rung_count].operand;
	else if (use && use->slot)
		name = *use->slot;
	return snprintf(out, size, "%s:%s", project_text(project, pou->name),
			project_text(project, name));
}

/* Filler.Idle: like a variable of the chart, which cannot have the same name. */
static int name_in_sfc(const struct project *project, const struct xref_target *target,
		       const struct xref_use *use, char *out, size_t size)
{
	const struct pou *pou = &project->pou[target->table - 1];
	const int index = target->index;

	if (index < 0)
		return written_name(project, use, out, size);
	return snprintf(out, size, "%s.%s", project_text(project, pou->name),
			project_text(project, target->what == XREF_STEP ?
				     pou->sfc->step[index].name :
				     target->what == XREF_ACTION ?
				     pou->sfc->action[index].name :
				     pou->sfc->transition[index].name));
}

int xref_name(const struct project *project, const struct xref_target *target,
	      const struct xref_use *use, char *out, size_t size)
{
	const struct var *var;

	switch (target->what) {
	case XREF_UNKNOWN:
		return written_name(project, use, out, size);
	case XREF_ADDRESS:
		return iec_addr_print(target->addr, out, size);
	case XREF_LABEL:
		return label_name(project, target, use, out, size);
	case XREF_POU:
		return snprintf(out, size, "%s", project_text(project,
			project->pou[target->index].name));
	case XREF_STRUCTURE:
		return snprintf(out, size, "%s", project_text(project,
			project->structure[target->index].name));
	case XREF_NAMED:
		return snprintf(out, size, "%s", project_text(project,
			project->named[target->index].name));
	case XREF_VALUE:
		return value_name(project, target->index, out, size);
	case XREF_STEP:
	case XREF_TRANSITION:
	case XREF_ACTION:
		return name_in_sfc(project, target, use, out, size);
	case XREF_VARIABLE:
		break;
	}
	var = xref_var((struct project *)(uintptr_t)project, target);
	return snprintf(out, size, "%s%s%s", table_name(project, target->table),
			target->table ? "." : "", project_text(project, var->name));
}

/* ---- which ---- */

struct wanted {
	const char *name;          /* NULL: all                               */
	struct xref_target addr;   /* a text that is not a name               */
	bool is_addr;
};

static void want(struct wanted *wanted, const char *name)
{
	*wanted = (struct wanted){ .name = name };
	if (!name)
		return;
	wanted->is_addr = iec_addr_parse(name, strlen(name), &wanted->addr.addr) ==
			  ADDR_OK;
	wanted->addr.what = XREF_ADDRESS;
}

static bool is_wanted(const struct xref *xref, const struct xref_use *use,
		      const struct wanted *wanted)
{
	char name[3 * LIMIT_NAME + 8];
	const char *last;

	if (!wanted->name)
		return true;
	if (wanted->is_addr && xref_touches(&use->target, &wanted->addr))
		return true;
	xref_name(xref->project, &use->target, use, name, sizeof(name));
	last = name + strcspn(name, use->target.what == XREF_VALUE ? "#" : ".:");
	return name_is(wanted->name, name, strlen(name)) ||
	       (*last && use->target.what != XREF_ADDRESS &&
		name_is(wanted->name, last + 1, strlen(last + 1)));
}

/* ---- order ---- */

int64_t xref_rank(const struct xref_target *target)
{
	/* In units of 1 << 58: numbers of tables need less than 18 bits. */
	static const int64_t first[] = {
		[XREF_POU] = 0, [XREF_STRUCTURE] = 4, [XREF_NAMED] = 5, [XREF_VALUE] = 6, [XREF_VARIABLE] = 8,
		[XREF_STEP] = 9, [XREF_TRANSITION] = 10, [XREF_ACTION] = 11,
		[XREF_LABEL] = 12, [XREF_ADDRESS] = 16, [XREF_UNKNOWN] = 20,
	};
	int64_t what = first[target->what] << 58;

	if (target->what == XREF_ADDRESS)
		return what | (int64_t)target->addr.area << 40 |
		       (int64_t)target->addr.byte << 16 | target->addr.bit << 8 |
		       target->addr.bits;
	return what | (int64_t)target->table << 40 | (uint32_t)(target->index + 1);
}

/* Merges two runs of sorted numbers of uses. */
static void merge(const struct xref *xref, const int *from, int *to, int a, int b, int end)
{
	int i = a, k = b;

	for (int n = a; n < end; n++) {
		bool left = i < b && (k >= end ||
					xref_rank(&xref->use[from[i]].target) <=
					xref_rank(&xref->use[from[k]].target));

		to[n] = left ? from[i++] : from[k++];
	}
}

/* Stable, so that uses of one thing stay in the order of the file. */
static const int *sorted(struct xref *xref)
{
	const int count = xref->count;
	int *order = arena_alloc(&xref->arena, sizeof(int) * ((size_t)count + 1));
	int *other = arena_alloc(&xref->arena, sizeof(int) * ((size_t)count + 1));

	if (!order || !other)
		return NULL;
	for (int i = 0; i < count; i++)
		order[i] = i;
	for (int64_t width = 1; width < count; width *= 2) {
		int *swap = order;

		for (int64_t at = 0; at < count; at += 2 * width) {
			int64_t b = at + width < count ? at + width : count;
			int64_t end = at + 2 * width < count ? at + 2 * width : count;

			merge(xref, order, other, (int)at, (int)b, (int)end);
		}
		order = other;
		other = swap;
	}
	return order;
}

/* ---- printing ---- */

static void print_place(const struct project *project, const struct xref_use *use,
			const struct sink *sink)
{
	sink_text(sink, use->file ? use->file : "");
	if (use->line)
		sink_printf(sink, ":%d", use->line);
	if (use->pou >= 0) {
		sink_text(sink, "\t");
		sink_text(sink, project_text(project, project->pou[use->pou].name));
	}
	if (use->rung && use->row)
		sink_printf(sink, " rung %d (%d,%d)", use->rung, use->row, use->col);
	else if (use->rung)
		sink_printf(sink, " rung %d", use->rung);
	sink_text(sink, use->off ? " off\n" : "\n");
}

static void print_line(const struct project *project, const struct xref_use *use,
		       const char *name, const struct sink *sink)
{
	sink_text(sink, *name ? name : "?");
	sink_text(sink, "\t");
	sink_text(sink, use->target.what == XREF_UNKNOWN ? "unknown" :
			kind_words[use->kind]);
	sink_text(sink, "\t");
	print_place(project, use, sink);
}

static void print_json(const struct project *project, const struct xref_use *use,
		       const char *name, const struct sink *sink)
{
	static const char *const what[] = { "unknown", "variable", "address", "label",
					    "pou", "structure", "step",
					    "transition", "action", "type", "value" };
	const struct var *var = xref_var((struct project *)(uintptr_t)project,
					 &use->target);

	sink_text(sink, "{\"name\": ");
	sink_json_text(sink, name);
	sink_printf(sink, ", \"what\": \"%s\", \"use\": \"%s\", \"file\": ",
		    what[use->target.what], kind_words[use->kind]);
	sink_json_text(sink, use->file);
	sink_printf(sink, ", \"line\": %d, \"pou\": ", use->line);
	sink_json_text(sink, use->pou < 0 ? NULL :
		       project_text(project, project->pou[use->pou].name));
	sink_printf(sink, ", \"rung\": %d, \"row\": %d, \"column\": %d, \"address\": ",
		    use->rung, use->row, use->col);
	sink_json_text(sink, var && var->at_text ?
		       project_text(project, var->at_text) :
		       use->target.what == XREF_ADDRESS ? name : NULL);
	sink_text(sink, use->off ? ", \"off\": true}" : ", \"off\": false}");
}

int xref_print(struct project *project, const char *name, bool json,
	       const struct xref_lines *lines, const struct sink *sink)
{
	struct xref xref;
	struct wanted wanted;
	const int *order = xref_make(&xref, project) ? sorted(&xref) : NULL;
	int shown = order ? 0 : -1;

	want(&wanted, name);
	sink_text(sink, json && order ? "[" : "");
	for (int i = 0; order && i < xref.count; i++) {
		struct xref_use *use = &xref.use[order[i]];
		char text[3 * LIMIT_NAME + 8];

		if (!is_wanted(&xref, use, &wanted))
			continue;
		xref_name(project, &use->target, use, text, sizeof(text));
		if (lines)
			use->line = lines->of(lines->context, use->line);
		if (json) {
			sink_text(sink, shown ? ",\n " : "\n ");
			print_json(project, use, text, sink);
		} else {
			print_line(project, use, text, sink);
		}
		shown++;
	}
	sink_text(sink, json && order ? "\n]\n" : "");
	xref_free(&xref);
	return shown;
}
