/* SPDX-License-Identifier: MIT
 *
 * plcopen_parts - which elements that act are one network, and networks as text.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include <stdlib.h>
#include <string.h>

/* ---- groups ---- */

struct parts {
	struct plcopen *c;
	struct plc_graph *graph;
	struct plc_groups *groups;
	int *last;              /* of each component: its last step              */
	bool *leads;            /* of each label: something stands behind it     */
};

static const struct plc_element *step_of(const struct plc_graph *graph, int step)
{
	return &graph->element[graph->step[step]];
}

static bool is_above(const struct plc_element *a, const struct plc_element *b)
{
	return a->y != b->y ? a->y < b->y : a < b;
}

/* The lowest label that stands above @e. */
static struct plc_element *label_of(const struct plc_graph *graph, const struct plc_element *e)
{
	struct plc_element *found = NULL;

	for (int i = 0; i < graph->elements; i++) {
		struct plc_element *label = &graph->element[i];

		if (label->kind == PLC_LABEL && is_above(label, e) && (!found || is_above(found, label)))
			found = label;
	}
	return found;
}

/* The highest label above @below, if that is given, behind which nothing stands. */
static struct plc_element *label_alone(const struct parts *p, const struct plc_element *below)
{
	struct plc_element *found = NULL;

	for (int i = 0; i < p->graph->elements; i++) {
		struct plc_element *label = &p->graph->element[i];

		if (label->kind == PLC_LABEL && !label->busy && !p->leads[i] &&
		    (!below || is_above(label, below)) && (!found || is_above(label, found)))
			found = label;
	}
	return found;
}

static bool has_labels(const struct plc_graph *graph)
{
	for (int i = 0; i < graph->elements; i++)
		if (graph->element[i].kind == PLC_LABEL)
			return true;
	return false;
}

static struct plc_group *add_group(struct parts *p, int first, struct plc_element *label)
{
	struct plc_group *group = arena_push(p->c->arena, &p->groups->group, &p->groups->count,
					     sizeof(*group));

	if (!group)
		return NULL;
	*group = (struct plc_group){ .first = first, .comment = "",
				     .node = label ? label->node : step_of(p->graph, first)->node };
	if (label) {
		label->busy = true;
		group->label = label->name;
		group->y = label->y;
	}
	return group;
}

/* Each label has a group, also if nothing stands behind it. */
static void add_labels_alone(struct parts *p, const struct plc_element *below, int first)
{
	struct plc_element *label;

	while ((label = label_alone(p, below)) && add_group(p, first, label))
		;
}

static void find_groups(struct parts *p)
{
	const bool labels = has_labels(p->graph);
	struct plc_group *group = NULL;
	int end = -1;

	for (int i = 0; i < p->graph->steps; i++) {
		const struct plc_element *e = step_of(p->graph, i);
		const struct plc_element *label = labels ? label_of(p->graph, e) : NULL;

		p->last[e->component] = i;
		if (label)
			p->leads[label - p->graph->element] = true;
	}
	for (int i = 0; i < p->graph->steps; i++) {
		const struct plc_element *e = step_of(p->graph, i);
		struct plc_element *label = labels ? label_of(p->graph, e) : NULL;

		if (label && label->busy)
			label = NULL;
		if (label)
			add_labels_alone(p, label, i);
		if (i > end || label)
			group = add_group(p, i, label);
		if (!group)
			return;
		group->count++;
		if (p->last[e->component] > end)
			end = p->last[e->component];
	}
	if (labels)
		add_labels_alone(p, NULL, p->graph->steps);
}

/* What is not known about the blocks of a group. */
static void find_unknown(struct parts *p)
{
	for (int g = 0; g < p->groups->count; g++) {
		struct plc_group *group = &p->groups->group[g];

		for (int i = 0; i < group->count; i++)
			p->last[step_of(p->graph, group->first + i)->component] = g;
	}
	for (int i = 0; i < p->graph->elements; i++) {
		const struct plc_element *e = &p->graph->element[i];
		struct plc_group *group;

		if (e->kind != PLC_BLOCK || plc_word(p->c, p->graph, e) != PLC_UNKNOWN)
			continue;
		group = &p->groups->group[p->last[e->component]];
		if (!group->missing)
			plc_report(p->c, REPORT_CHANGED, e->node,
				   report_said(p->c->report, REPORTED("the type of the block \"%s\" is not known: its network is kept and OFF")),
				   e->name);
		group->missing = e->name;
	}
}

/* A comment rather stands above its network: what is above the comment counts as twice as far away. */
static int distance(const struct plc_graph *graph, const struct plc_group *group,
		    const struct plc_element *comment)
{
	int least = group->count ? 1 << 30 : abs(group->y - comment->y);

	for (int i = 0; i < group->count; i++) {
		const int down = step_of(graph, group->first + i)->y - comment->y;

		if ((down < 0 ? -2 * down : down) < least)
			least = down < 0 ? -2 * down : down;
	}
	return least;
}

/* CODESYS gives no places: then the order of the file tells what belongs together. */
static bool is_placed(const struct plc_graph *graph)
{
	for (int i = 0; i < graph->elements; i++)
		if (graph->element[i].x || graph->element[i].y)
			return true;
	return false;
}

static int distance_in_file(const struct plc_graph *graph, const struct plc_group *group,
			    const struct plc_element *comment)
{
	int least = 1 << 30;

	for (int i = 0; i < group->count; i++) {
		const struct plc_element *e = step_of(graph, group->first + i);

		if (e > comment && e - comment < least)
			least = (int)(e - comment);
	}
	return least;
}

/* A comment belongs to the nearest network. */
static void place_comments(struct parts *p)
{
	int (*away)(const struct plc_graph *, const struct plc_group *, const struct plc_element *) =
		is_placed(p->graph) ? distance : distance_in_file;

	for (int i = 0; i < p->graph->elements; i++) {
		const struct plc_element *e = &p->graph->element[i];
		struct plc_group *near = NULL;
		const char *text;

		if (e->kind != PLC_COMMENT)
			continue;
		text = plc_trim(p->c, e->name);
		for (int g = 0; *text && g < p->groups->count; g++)
			if (!near || away(p->graph, &p->groups->group[g], e) < away(p->graph, near, e))
				near = &p->groups->group[g];
		if (near)
			near->comment = plc_print(p->c, "%s%s%s", near->comment, *near->comment ? "\n" : "", text);
		else if (*text)
			plc_report(p->c, REPORT_LOST, e->node,
				   report_said(p->c->report, REPORTED("the comment \"%.100s\" is left out: the body has no network")), text);
	}
}

/* ---- what does not act ---- */

/* Elements that lead to nothing that acts would be lost without a word. */
static void report_idle(struct plcopen *c, struct plc_graph *graph)
{
	bool *acts = arena_alloc(c->arena, (size_t)graph->elements + 1);

	for (int i = 0; acts && i < graph->steps; i++)
		acts[step_of(graph, i)->component] = true;
	for (int i = 0; acts && i < graph->elements; i++) {
		const struct plc_element *e = &graph->element[i];

		if ((e->kind == PLC_CONTACT || e->kind == PLC_IN || e->kind == PLC_CONTINUATION ||
		     e->kind == PLC_CONNECTOR) && !acts[e->component])
			plc_report(c, REPORT_LOST, e->node,
				   report_said(c->report, REPORTED("\"%s\" leads to nothing that acts and is left out")),
				   e->name);
	}
}

void plc_groups_make(struct plcopen *c, struct plc_graph *graph, struct plc_groups *groups)
{
	struct parts parts = { c, graph, groups, NULL, NULL };

	*groups = (struct plc_groups){ .group = NULL };
	parts.last = arena_alloc(c->arena, sizeof(int) * ((size_t)graph->elements + 1));
	parts.leads = arena_alloc(c->arena, (size_t)graph->elements + 1);
	if (!parts.last || !parts.leads)
		return;
	for (int i = 0; i < graph->elements; i++)
		graph->element[i].busy = false;
	find_groups(&parts);
	find_unknown(&parts);
	place_comments(&parts);
	report_idle(c, graph);
}

/* ---- networks ---- */

static void put_heading(struct plcopen *c, const struct plc_group *group)
{
	c->at = group->node->line;
	if (*group->comment) {
		plc_comment(c, group->comment);
		plc_put(c, "\n");
	}
	plc_put(c, "NETWORK");
	if (group->missing)
		plc_put(c, " OFF");
	if (group->label)
		plc_put(c, " %s", group->label);
	if (group->missing)
		plc_put(c, " \"%s is not known\"", group->missing);
	plc_put(c, "\n");
}

/* Statements that cannot run stand in a comment. */
static void begin_statements(struct plc_lines *lines, const struct plc_group *group)
{
	struct plcopen *c = lines->c;

	c->at = group->node->line;
	if (*group->comment) {
		plc_put(c, "%s", lines->indent);
		plc_comment(c, group->comment);
		plc_put(c, "\n");
	}
	if (group->label)
		plc_put(c, "%s%s:\n", lines->indent, group->label);
	if (group->missing)
		plc_put(c, "%s(* %s is not known:\n", lines->indent, group->missing);
}

static void put_group(struct plc_lines *lines, const struct plc_group *group)
{
	struct plcopen *c = lines->c;

	if (lines->networks) {
		plc_picture(c, lines->graph, group);
		c->rungs++;
		put_heading(c, group);
	} else {
		begin_statements(lines, group);
	}
	for (int i = 0; i < group->count && !lines->failed; i++)
		plc_lines_step(lines, &lines->graph->element[lines->graph->step[group->first + i]]);
	if (!lines->networks && group->missing)
		plc_put(c, "%s*)\n", lines->indent);
	c->count.networks++;
}

void plc_networks(struct plcopen *c, struct plc_graph *graph, const struct plc_groups *groups,
		  bool st, const char *indent)
{
	struct plc_lines lines;

	if (!plc_lines_init(&lines, c, graph, !st, indent))
		return;
	for (int i = 0; i < groups->count && !lines.failed; i++)
		put_group(&lines, &groups->group[i]);
}
