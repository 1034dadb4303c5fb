/* SPDX-License-Identifier: MIT
 *
 * sim_panel_line - the parts of a line of the panel; see sim_panel_line.h.
 *
 * A GtkLabel of two lines is no way: GTK 4.8.3 warns that its natural size is less than its least one.
 */
#include "editor-gtk/live/sim_panel_line.h"

#define GAP 6 /* px between parts                                              */
#define AIR 2 /* px above and below two lines                                  */

struct _LadderSimLine {
	GtkWidget parent;
	GtkWidget *part[LINE_PARTS];
	int end_most;      /* px: a value that becomes shorter does not move the others */
};

G_DEFINE_FINAL_TYPE(LadderSimLine, ladder_sim_line, GTK_TYPE_WIDGET)

enum form {
	SIDE_BY_SIDE,
	NAME_ABOVE_ADDRESS, /* the end beside both                              */
	NAME_ABOVE_ALL,
};

/* Of each part; 0: it is empty. */
struct sizes { int least[LINE_PARTS], natural[LINE_PARTS]; };

static struct sizes sizes_of(LadderSimLine *line, GtkOrientation along)
{
	struct sizes sizes = { 0 };

	for (int i = 0; i < LINE_PARTS; i++)
		gtk_widget_measure(line->part[i], along, -1, &sizes.least[i], &sizes.natural[i], NULL, NULL);
	return sizes;
}

static struct sizes widths_of(LadderSimLine *line)
{
	struct sizes sizes = sizes_of(line, GTK_ORIENTATION_HORIZONTAL);

	line->end_most = MAX(line->end_most, sizes.natural[LINE_END]);
	sizes.natural[LINE_END] = line->end_most;
	return sizes;
}

/* Two widths side by side. */
static int beside(int left, int right)
{
	return left && right ? left + GAP + right : left + right;
}

static int side_by_side(const int *width)
{
	int all = 0;

	for (int i = 0; i < LINE_PARTS; i++)
		all = beside(all, width[i]);
	return all;
}

/* Without name and lead. */
static int below_name(const int *width, int end)
{
	return beside(beside(width[LINE_ADDRESS], width[LINE_ABOUT]), end);
}

static enum form form_in(const struct sizes *widths, int width)
{
	const int *natural = widths->natural;
	const int two = MAX(natural[LINE_NAME], below_name(natural, 0));

	if (side_by_side(natural) <= width)
		return SIDE_BY_SIDE;
	if (below_name(natural, 0) && beside(beside(natural[LINE_LEAD], two), natural[LINE_END]) <= width)
		return NAME_ABOVE_ADDRESS;
	return NAME_ABOVE_ALL;
}

/* Of the name, and of what stands beside it. */
static int upper_height(const struct sizes *heights, enum form form)
{
	const int *natural = heights->natural;

	return form == NAME_ABOVE_ALL ? MAX(natural[LINE_NAME], natural[LINE_LEAD]) : natural[LINE_NAME];
}

/* Of what stands below the name. */
static int lower_height(const struct sizes *heights, enum form form)
{
	const int *natural = heights->natural;
	const int small = MAX(natural[LINE_ADDRESS], natural[LINE_ABOUT]);

	return form == NAME_ABOVE_ADDRESS ? small : MAX(small, natural[LINE_END]);
}

static int height_of(const struct sizes *heights, enum form form)
{
	const int *natural = heights->natural;
	int most = 0;

	if (form == SIDE_BY_SIDE) {
		for (int i = 0; i < LINE_PARTS; i++)
			most = MAX(most, natural[i]);
		return most;
	}
	most = upper_height(heights, form) + lower_height(heights, form) + 2 * AIR;
	return MAX(most, MAX(natural[LINE_LEAD], natural[LINE_END]));
}

static GtkSizeRequestMode request_mode(GtkWidget *widget)
{
	(void)widget;
	return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

static void measure(GtkWidget *widget, GtkOrientation along, int for_size, int *least, int *natural,
		    int *least_baseline, int *natural_baseline)
{
	LadderSimLine *line = LADDER_SIM_LINE(widget);
	const struct sizes widths = widths_of(line);

	*least_baseline = *natural_baseline = -1;
	if (along == GTK_ORIENTATION_HORIZONTAL) {
		const int below = below_name(widths.least, widths.least[LINE_END]);

		*least = beside(widths.least[LINE_LEAD], MAX(widths.least[LINE_NAME], below));
		*natural = MAX(side_by_side(widths.natural), *least);
		return;
	}
	const struct sizes heights = sizes_of(line, GTK_ORIENTATION_VERTICAL);

	*least = *natural = height_of(&heights, for_size < 0 ? SIDE_BY_SIDE : form_in(&widths, for_size));
}

/* ---- places ---- */

static void put(LadderSimLine *line, enum line_part part, GdkRectangle at)
{
	gtk_widget_size_allocate(line->part[part], &at, -1);
}

/* Puts parts @first … @last but the name from @x to @to; the last one ends there, and takes what is left.
 * Where there is too little room, those that can be cut become narrower. */
static void put_below(LadderSimLine *line, const struct sizes *widths, enum line_part last, GdkRectangle room)
{
	const enum line_part order[] = { LINE_ADDRESS, LINE_ABOUT, LINE_END };
	const int to = room.x + room.width;
	int least_behind = below_name(widths->least, last == LINE_END ? widths->least[LINE_END] : 0);

	for (guint i = 0; i < G_N_ELEMENTS(order) && order[i] <= last; i++) {
		const enum line_part part = order[i];
		const int least = widths->least[part];

		least_behind = MAX(least_behind - least - (least ? GAP : 0), 0);
		room.width = MIN(widths->natural[part], to - room.x - least_behind - (least_behind ? GAP : 0));
		room.width = MAX(room.width, least);
		if (part == LINE_END)
			room.x = MAX(room.x, to - room.width);
		put(line, part, room);
		room.x += room.width + (room.width ? GAP : 0);
	}
}

static void put_side_by_side(LadderSimLine *line, const struct sizes *widths, int width, int height)
{
	GdkRectangle at = { .height = height };
	int left = width - side_by_side(widths->natural);

	for (int i = 0; i < LINE_PARTS; i++) {
		at.width = widths->natural[i] + (i == LINE_NAME ? left : 0);
		put(line, i, at);
		at.x += at.width + (widths->natural[i] ? GAP : 0);
	}
}

static void size_allocate(GtkWidget *widget, int width, int height, int baseline)
{
	LadderSimLine *line = LADDER_SIM_LINE(widget);
	const struct sizes widths = widths_of(line), heights = sizes_of(line, GTK_ORIENTATION_VERTICAL);
	const enum form form = form_in(&widths, width);
	const int name = upper_height(&heights, form), lower = lower_height(&heights, form);
	const int lead = widths.natural[LINE_LEAD], end = widths.natural[LINE_END];
	const int x = lead ? lead + GAP : 0, y = MAX((height - name - lower) / 2, 0);
	GdkRectangle room = { x, y + name, width - x, lower };

	(void)baseline;
	if (form == SIDE_BY_SIDE) {
		put_side_by_side(line, &widths, width, height);
		return;
	}
	if (form == NAME_ABOVE_ADDRESS) {
		room.width -= end ? end + GAP : 0;
		put(line, LINE_END, (GdkRectangle){ width - end, 0, end, height });
	}
	put(line, LINE_LEAD, (GdkRectangle){ 0, y, lead, form == NAME_ABOVE_ALL ? name : height - 2 * y });
	put(line, LINE_NAME, (GdkRectangle){ x, y, room.width, name });
	put_below(line, &widths, form == NAME_ABOVE_ALL ? LINE_END : LINE_ABOUT, room);
}

/* ---- the widget ---- */

GtkBox *ladder_sim_line_part(LadderSimLine *line, enum line_part part)
{
	return GTK_BOX(line->part[part]);
}

void ladder_sim_line_begin(LadderSimLine *line)
{
	line->end_most = 0;
}

static void dispose(GObject *object)
{
	LadderSimLine *line = LADDER_SIM_LINE(object);

	for (int i = 0; i < LINE_PARTS; i++)
		g_clear_pointer(&line->part[i], gtk_widget_unparent);
	G_OBJECT_CLASS(ladder_sim_line_parent_class)->dispose(object);
}

static void ladder_sim_line_class_init(LadderSimLineClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->get_request_mode = request_mode;
	widget->measure = measure;
	widget->size_allocate = size_allocate;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GROUP);
}

static void ladder_sim_line_init(LadderSimLine *line)
{
	for (int i = 0; i < LINE_PARTS; i++) {
		line->part[i] = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, GAP);
		gtk_widget_set_parent(line->part[i], GTK_WIDGET(line));
	}
}

GtkWidget *ladder_sim_line_new(void)
{
	return g_object_new(LADDER_TYPE_SIM_LINE, NULL);
}
