/* SPDX-License-Identifier: MIT
 *
 * diff_networks - differences of networks; see diff_networks.h.
 *
 * Networks are matched by their longest common subsequence, then by equal texts elsewhere (they moved). What is
 * left between two matched networks is paired by its label or title, then by a line that both have.
 */
#include "editor-gtk/draw/diff_networks.h"

#include "editor-gtk/draw/diff_draw.h"

#include <string.h>

#define PAIRS_MOST 4000000 /* networks times networks that are compared          */

struct side {
	const struct project *project;
	const struct pou *pou;   /* NULL: there is none                            */
	char **text;             /* of each network: the same if nothing differs    */
	int *like;               /* its match in the other version; -1: none        */
	bool *moved;
	int count;
};

static struct side side_of(const struct project *project, const struct pou *pou)
{
	struct side side = { .project = project, .pou = pou, .count = pou ? fbd_layout_networks(pou) : 0 };

	side.text = g_new0(char *, side.count + 1);
	side.like = g_new(int, side.count + 1);
	side.moved = g_new0(bool, side.count + 1);
	for (int i = 0; i < side.count; i++) {
		side.text[i] = fbd_layout_text(project, pou, i);
		side.like[i] = -1;
	}
	return side;
}

static void side_clear(struct side *side)
{
	g_strfreev(side->text);
	g_free(side->like);
	g_free(side->moved);
}

static void join(struct side *a, int i, struct side *b, int k)
{
	a->like[i] = k;
	b->like[k] = i;
}

static bool is_free_pair(const struct side *a, int i, const struct side *b, int k)
{
	return a->like[i] < 0 && b->like[k] < 0;
}

/* The lengths of the longest common parts of both behind each pair; NULL: there are too many. */
static int *common_parts(const struct side *a, const struct side *b)
{
	const int wide = b->count + 1;
	int *part;

	if ((gint64)(a->count + 1) * wide > PAIRS_MOST)
		return NULL;
	part = g_new0(int, (a->count + 1) * wide);
	for (int i = a->count - 1; i >= 0; i--)
		for (int k = b->count - 1; k >= 0; k--)
			part[i * wide + k] = strcmp(a->text[i], b->text[k]) == 0 ? part[(i + 1) * wide + k + 1] + 1 :
				MAX(part[(i + 1) * wide + k], part[i * wide + k + 1]);
	return part;
}

static void match_same(struct side *a, struct side *b)
{
	int *part = common_parts(a, b);
	const int wide = b->count + 1;

	for (int i = 0, k = 0; i < a->count && k < b->count;) {
		if (strcmp(a->text[i], b->text[k]) == 0)
			join(a, i++, b, k++);
		else if (!part)
			i++, k++;
		else if (part[(i + 1) * wide + k] >= part[i * wide + k + 1])
			i++;
		else
			k++;
	}
	g_free(part);
}

static void match_moved(struct side *a, struct side *b)
{
	GHashTable *there = g_hash_table_new(g_str_hash, g_str_equal);

	for (int k = b->count - 1; k >= 0; k--)
		if (b->like[k] < 0)
			g_hash_table_insert(there, b->text[k], GINT_TO_POINTER(k + 1));
	for (int i = 0; i < a->count; i++) {
		const int k = a->like[i] < 0 ? GPOINTER_TO_INT(g_hash_table_lookup(there, a->text[i])) - 1 : -1;

		if (k < 0 || b->like[k] >= 0)
			continue;
		join(a, i, b, k);
		a->moved[i] = b->moved[k] = true;
	}
	g_hash_table_unref(there);
}

/* ---- networks that were changed ---- */

/* Line @number of a text of fbd_layout_text(). */
static char *line_of(const char *text, int number)
{
	for (; number > 0 && text; number--) {
		text = strchr(text, '\n');
		text = text ? text + 1 : NULL;
	}
	return text ? g_strndup(text, strcspn(text, "\n")) : g_strdup("");
}

enum likeness { SAME_LABEL, SAME_TITLE, SAME_LINE, LIKENESSES };
enum { LABEL_LINE = 1, TITLE_LINE = 2, HEADING_LINES = 4 }; /* of fbd_layout_text() */

static bool has_line_of(const char *a, const char *b)
{
	char **lines = g_strsplit(a, "\n", -1), **others = g_strsplit(b, "\n", -1);
	bool has = false;

	for (gsize i = HEADING_LINES; i < g_strv_length(lines) && !has; i++)
		for (gsize k = HEADING_LINES; k < g_strv_length(others) && !has; k++)
			has = *lines[i] && strcmp(lines[i], others[k]) == 0;
	g_strfreev(others);
	g_strfreev(lines);
	return has;
}

static bool is_like(const char *a, const char *b, enum likeness likeness)
{
	const int line = likeness == SAME_LABEL ? LABEL_LINE : TITLE_LINE;
	char *x, *y;
	bool like;

	if (likeness == SAME_LINE)
		return has_line_of(a, b);
	x = line_of(a, line);
	y = line_of(b, line);
	like = *x && strcmp(x, y) == 0;
	g_free(x);
	g_free(y);
	return like;
}

/* Pairs networks from @i and from @k up to the next matched ones. */
static void match_gap(struct side *a, int i, int end_a, struct side *b, int k, int end_b)
{
	for (int likeness = 0; likeness < LIKENESSES; likeness++)
		for (int x = i; x < end_a; x++)
			for (int y = k; y < end_b; y++)
				if (is_free_pair(a, x, b, y) &&
				    is_like(a->text[x], b->text[y], (enum likeness)likeness))
					join(a, x, b, y);
	/* one for one, and nothing else there: it was written anew */
	if (end_a - i == 1 && end_b - k == 1 && is_free_pair(a, i, b, k))
		join(a, i, b, k);
}

static void match_changed(struct side *a, struct side *b)
{
	int *anchor = g_memdup2(a->like, (gsize)(a->count + 1) * sizeof(int));
	int i = 0, k = 0;

	for (int end = 0; end <= a->count; end++) {
		if (end < a->count && (anchor[end] < 0 || a->moved[end]))
			continue;
		match_gap(a, i, end, b, k, end < a->count ? anchor[end] : b->count);
		i = end + 1;
		k = end < a->count ? anchor[end] + 1 : b->count;
	}
	g_free(anchor);
}

/* ---- the list ---- */

/* Without the hints of places, in which nobody reads a difference. */
static char *readable(const char *text)
{
	char **lines = g_strsplit(text, "\n", -1);
	GString *out = g_string_new(NULL);

	for (gsize i = 0; i < g_strv_length(lines); i++) {
		char *hint = i < HEADING_LINES ? NULL : g_strrstr(lines[i], " {");

		if (hint)
			*hint = '\0';
		if (i > 0) /* the first says whether it is OFF */
			g_string_append_printf(out, "%s\n", lines[i]);
		else if (*lines[i] == '1')
			g_string_append(out, "OFF\n");
	}
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}

static void add_network(GArray *found, const struct side *a, int i, const struct side *b, int k)
{
	struct diff_network one = { i, k, i >= 0 && a->moved[i], NULL };
	char *from = i < 0 ? g_strdup("") : readable(a->text[i]);
	char *to = k < 0 ? g_strdup("") : readable(b->text[k]);

	one.words = diff_words(from, to);
	g_free(from);
	g_free(to);
	g_array_append_val(found, one);
}

static void clear_network(gpointer data)
{
	g_free(((struct diff_network *)data)->words);
}

GArray *diff_networks(const struct project *a, const struct pou *pou_a, const struct project *b,
		      const struct pou *pou_b)
{
	GArray *found = g_array_new(FALSE, FALSE, sizeof(struct diff_network));
	struct side x = side_of(a, pou_a), y = side_of(b, pou_b);
	int i = 0;

	g_array_set_clear_func(found, clear_network);
	match_same(&x, &y);
	match_moved(&x, &y);
	match_changed(&x, &y);
	for (int k = 0; k <= y.count; k++) {
		const int to = k < y.count && !y.moved[k] ? y.like[k] : k < y.count ? -1 : x.count;

		for (; i < to; i++)
			if (x.like[i] < 0)
				add_network(found, &x, i, &y, -1);
		if (k == y.count)
			break;
		if (y.like[k] < 0 || y.moved[k] || strcmp(x.text[y.like[k]], y.text[k]) != 0)
			add_network(found, &x, y.like[k], &y, k);
		i = MAX(i, to + 1);
	}
	side_clear(&x);
	side_clear(&y);
	return found;
}

/* ---- boxes ---- */

static void append_pin(GString *text, const struct fbd_graph *graph, const struct fbd_pin *pin)
{
	const int source = pin->output ? -1 : fbd_graph_source(graph, pin - graph->pin);
	const char *wire = pin->wire >= 0 ? graph->wire[pin->wire].name : NULL;

	g_string_append_printf(text, "\n%s %d%d%d %s", pin->name, pin->output, pin->negated, pin->previous,
			       pin->operand ? pin->operand : wire ? wire : "");
	if (source >= 0 && !wire) /* a wire without a name: from which box */
		g_string_append_printf(text, " %s.%s", fbd_box_title(&graph->box[graph->pin[source].box]),
				       graph->pin[source].name);
}

/* All that is read at a box, as a text. */
static char *box_text(const struct fbd_graph *graph, const struct fbd_box *box)
{
	GString *text = g_string_new(NULL);

	g_string_append_printf(text, "%d %s %s %s", box->kind, box->type ? box->type : "",
			       box->instance ? box->instance : "", box->target ? box->target : "");
	for (int i = 0; i < box->pins; i++)
		append_pin(text, graph, &graph->pin[box->first_pin + i]);
	return g_string_free(text, FALSE);
}

GArray *diff_mark_boxes(const struct fbd_graph *own, const struct fbd_graph *other)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct fbd_mark));
	GHashTable *there = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);

	for (int i = 0; i < other->box_count; i++) {
		char *text = box_text(other, &other->box[i]);
		const int count = GPOINTER_TO_INT(g_hash_table_lookup(there, text));

		g_hash_table_replace(there, text, GINT_TO_POINTER(count + 1));
	}
	for (int i = 0; i < own->box_count; i++) {
		const struct fbd_mark mark = { i, -1, MARK_CHANGED };
		char *text = box_text(own, &own->box[i]);
		const int count = GPOINTER_TO_INT(g_hash_table_lookup(there, text));

		if (count > 0) {
			g_hash_table_replace(there, text, GINT_TO_POINTER(count - 1));
		} else {
			g_array_append_val(marks, mark);
			g_free(text);
		}
	}
	g_hash_table_unref(there);
	return marks;
}
