/* SPDX-License-Identifier: MIT
 *
 * panel - lists of rows in columns, and delayed refreshes after changes of the document.
 */
#include "editor-gtk/document/panel.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/kit/settings.h"

/* ---- cells ---- */

static const char *tone_icon(enum panel_tone tone)
{
	static const char *const icon[] = {
		[PANEL_PLAIN] = NULL, [PANEL_WARNING] = "dialog-warning-symbolic",
		[PANEL_ERROR] = "dialog-error-symbolic",
	};

	return icon[tone];
}

void panel_speak(GtkWidget *cell, const LadderPanelRow *row)
{
	GtkWidget *of_cell = gtk_widget_get_parent(cell);
	GtkWidget *of_row = of_cell ? gtk_widget_get_parent(of_cell) : NULL;

	if (of_row && row->spoken)
		gtk_accessible_update_property(GTK_ACCESSIBLE(of_row),
			GTK_ACCESSIBLE_PROPERTY_LABEL, row->spoken, -1);
}

/* Shows the row of a cell now, and again when the row changes. */
static void follow(GtkListItem *item, void (*show)(LadderPanelRow *row, GtkListItem *item))
{
	LadderPanelRow *row = gtk_list_item_get_item(item);

	show(row, item);
	g_signal_connect(row, "changed", G_CALLBACK(show), item);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer unused)
{
	(void)factory;
	(void)unused;
	g_signal_handlers_disconnect_by_data(gtk_list_item_get_item(item), item);
}

static void setup_label(GtkSignalListItemFactory *factory, GtkListItem *item,
			gpointer column)
{
	GtkWidget *label = gtk_label_new(NULL);

	(void)factory;
	g_object_set_data(G_OBJECT(label), "column", column);
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_list_item_set_child(item, label);
}

static void setup_middle(GtkSignalListItemFactory *factory, GtkListItem *item,
			 gpointer column)
{
	setup_label(factory, item, column);
	gtk_label_set_ellipsize(GTK_LABEL(gtk_list_item_get_child(item)),
				PANGO_ELLIPSIZE_MIDDLE);
}

static void show_label(LadderPanelRow *row, GtkListItem *item)
{
	GtkWidget *label = gtk_list_item_get_child(item);
	const char *text = panel_row_text(row, GPOINTER_TO_INT(
		g_object_get_data(G_OBJECT(label), "column")));

	gtk_label_set_text(GTK_LABEL(label), text);
	tip_set(label, text);
	panel_speak(label, row);
}

static void bind_label(GtkSignalListItemFactory *factory, GtkListItem *item,
		       gpointer column)
{
	(void)factory;
	(void)column;
	follow(item, show_label);
}

static void setup_icon(GtkSignalListItemFactory *factory, GtkListItem *item,
		       gpointer unused)
{
	(void)factory;
	(void)unused;
	gtk_list_item_set_child(item, gtk_image_new());
}

static void show_icon(LadderPanelRow *row, GtkListItem *item)
{
	GtkWidget *image = gtk_list_item_get_child(item);

	gtk_image_set_from_icon_name(GTK_IMAGE(image), tone_icon(row->tone));
	style_set(image, "error", row->tone == PANEL_ERROR);
	style_set(image, "warning", row->tone == PANEL_WARNING);
	tip_set(image, row->note);
	gtk_accessible_update_property(GTK_ACCESSIBLE(image), GTK_ACCESSIBLE_PROPERTY_LABEL,
		row->note ? row->note : row->tone == PANEL_ERROR ? _("Error") :
		row->tone == PANEL_WARNING ? _("Warning") : "", -1);
	panel_speak(image, row);
}

static void bind_icon(GtkSignalListItemFactory *factory, GtkListItem *item,
		      gpointer unused)
{
	(void)factory;
	(void)unused;
	follow(item, show_icon);
}

/* ---- order ---- */

/* Sort key as in a file manager: case folded, numbers by value. Caller: g_free. */
static char *order_key(const LadderPanelRow *row, int column)
{
	char *folded = g_utf8_casefold(panel_row_text(row, column), -1);
	char *key = g_utf8_collate_key_for_filename(folded, -1);

	g_free(folded);
	return key;
}

static int by_text(gconstpointer left, gconstpointer right, gpointer column)
{
	char *x = order_key(left, GPOINTER_TO_INT(column));
	char *y = order_key(right, GPOINTER_TO_INT(column));
	const int order = g_strcmp0(x, y);

	g_free(x);
	g_free(y);
	return order < 0 ? GTK_ORDERING_SMALLER : order > 0 ? GTK_ORDERING_LARGER :
	       GTK_ORDERING_EQUAL;
}

static int by_number(gconstpointer left, gconstpointer right, gpointer unused)
{
	const LadderPanelRow *a = left, *b = right;

	(void)unused;
	return a->number < b->number ? GTK_ORDERING_SMALLER :
	       a->number > b->number ? GTK_ORDERING_LARGER : GTK_ORDERING_EQUAL;
}

static int by_tone(gconstpointer left, gconstpointer right, gpointer unused)
{
	const LadderPanelRow *a = left, *b = right;

	(void)unused;
	return a->tone > b->tone ? GTK_ORDERING_SMALLER :
	       a->tone < b->tone ? GTK_ORDERING_LARGER : GTK_ORDERING_EQUAL;
}

#define HEADING_ROOM 14 /* padding of a heading                               */
#define ARROW_ROOM 17   /* of the arrow of sorting                            */

int panel_heading_width(GtkWidget *view, const char *name)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(view, NULL);
	char *bold = g_markup_printf_escaped("<b>%s</b>", name);
	int width;

	pango_layout_set_markup(layout, bold, -1);
	pango_layout_get_pixel_size(layout, &width, NULL);
	g_free(bold);
	g_object_unref(layout);
	return width;
}

/* ---- widths ---- */

#define LABEL_ROOM 24   /* padding of a cell with a label                       */
#define CELL_ROOM 36    /* of one that is edited                                */
#define BUTTON_ROOM 54  /* of one with an arrow                                 */
#define ARROW_LEAST 70  /* with an arrow and no text                           */
#define ICON_ROOM 34    /* a column of icons                                    */
#define COLUMN_MOST 260 /* for a longer text a column gets no wider             */

struct panel_column {
	GtkColumnViewColumn *column; /* borrowed                                  */
	int text;     /* which of a row's; -1: none, an icon or a check box     */
	int room;     /* beside the text                                        */
	bool bold;    /* PANEL_BOLD                                             */
	int width;    /* wished by the panel; 0: natural                        */
	int least;    /* px for its heading as it is now                        */
	int line, low; /* the same in one line, and in two                      */
	int need;     /* px for the longest text so far: widths settle          */
	int whole;    /* the same, of a text that is wider than COLUMN_MOST, too */
	int set;      /* given last; another one is a person's                  */
	int field;    /* as @text, of a check box, too                          */
	int leaves;   /* 1: the first to leave a narrow list; 0: it stays       */
	bool away;    /* it left                                                */
	enum { FREE, SHOWN, HIDDEN } chosen; /* by a person                     */
};

/* The longest text of the rows in a column; "": none. Borrowed. */
static const char *longest(struct panel_list *list, int text)
{
	const guint count = g_list_model_get_n_items(G_LIST_MODEL(list->store));
	const char *found = "";
	glong most = 0;

	for (guint i = 0; i < count; i++) {
		LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(list->store), i);
		const char *each = panel_row_text(row, text);
		const glong len = each ? g_utf8_strlen(each, -1) : 0;

		if (len > most) {
			most = len;
			found = each;
		}
		g_object_unref(row);
	}
	return found;
}

/* Where a column expands, its texts may end in an ellipsis first: it gets what is left over. */
static int most_of(const struct panel_column *column)
{
	const bool expands = gtk_column_view_column_get_expand(column->column);

	return expands && column->width ? column->width : COLUMN_MOST;
}

static void measure(struct panel_list *list)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(list->view), NULL);

	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);
		int width;

		if (each->text < 0)
			continue;
		pango_layout_set_text(layout, longest(list, each->text), -1);
		pango_layout_get_pixel_size(layout, &width, NULL);
		if (each->bold)
			width = panel_heading_width(GTK_WIDGET(list->view), longest(list, each->text));
		each->need = MAX(each->need, MIN(width + each->room, most_of(each)));
		each->whole = MAX(each->whole, width + each->room);
	}
	g_object_unref(layout);
}

/* Is the width ours to choose? Otherwise it is natural, or a person's. */
static bool is_ours(const struct panel_column *column)
{
	return column->width &&
	       list_column_width(column->column) == column->set;
}

/* Px that a column may be narrower: its wish less what its texts need. */
static int slack_of(const struct panel_column *column)
{
	return is_ours(column) ? MAX(column->width - MAX(column->need, column->least), 0) : 0;
}

/* Px that its texts need beyond its heading. */
static int spare_of(const struct panel_column *column)
{
	return is_ours(column) ? MAX(column->need - column->least, 0) : 0;
}

/* The part of @px that falls to @own of @all, rounded up. */
static int share(int own, int px, int all)
{
	return all > 0 ? (own * px + all - 1) / all : 0;
}

static int wish_of(const struct panel_column *column)
{
	const int now = list_column_width(column->column);

	if (column->width && !is_ours(column))
		return now;
	return MAX(MAX(column->width, column->need), column->least);
}

/* Px that the texts of a column that expands lack, if it gets its wish alone. */
static int lack_of(const struct panel_column *column)
{
	return gtk_column_view_column_get_expand(column->column) ?
	       MAX(column->whole - wish_of(column), 0) : 0;
}

/* Px that a column without a wish gives up before others do: it expands, so it has what is left. */
static int gift_of(const struct panel_column *column)
{
	return !column->width && gtk_column_view_column_get_expand(column->column) ?
	       MAX(column->need - MAX(column->least, COLUMN_MOST / 2), 0) : 0;
}

/* Px of its longest text that one that does not expand cuts. */
static int cut_of(const struct panel_column *column)
{
	return is_ours(column) && !gtk_column_view_column_get_expand(column->column) ?
	       MAX(column->whole - wish_of(column), 0) : 0;
}

static bool has_column(struct panel_list *list, const GtkColumnViewColumn *column)
{
	bool has = false;

	for (guint i = 0; i < list->columns->len && !has; i++)
		has = g_array_index(list->columns, struct panel_column, i).column == column;
	return has;
}

/* Px of the columns that the owner of the list added by itself, such as handles. */
static int width_of_others(struct panel_list *list)
{
	GListModel *columns = gtk_column_view_get_columns(list->view);
	int width = 0;

	for (guint i = 0; i < g_list_model_get_n_items(columns); i++) {
		GtkColumnViewColumn *column = g_list_model_get_item(columns, i);
		const int now = gtk_column_view_column_get_fixed_width(column);

		if (!has_column(list, column))
			width += now > 0 ? now : ICON_ROOM;
		g_object_unref(column);
	}
	return width;
}

/* What the columns of a list need, px: see fit(). */
struct widths {
	int all;    /* all wishes                                             */
	int lack;   /* of the texts of one that expands                       */
	int slack;  /* all wishes less what texts and headings need           */
	int spare;  /* what texts need beyond their headings                   */
	int cut;    /* of the texts of those that do not expand                */
	int gives;  /* what those that expand and have no wish can do without  */
};

static struct widths widths_of(struct panel_list *list)
{
	struct widths of = { .all = width_of_others(list) };

	for (guint i = 0; i < list->columns->len; i++) {
		const struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		if (each->leaves ? each->away : !gtk_column_view_column_get_visible(each->column))
			continue;
		of.all += wish_of(each);
		of.lack += lack_of(each);
		of.slack += slack_of(each);
		of.spare += spare_of(each);
		of.cut += cut_of(each);
		of.gives += gift_of(each);
	}
	return of;
}

/* A copy of @name, in two lines if it has a blank: broken at the one nearest to the middle. Caller
 * frees. */
static char *two_lines(const char *name)
{
	char *copy = g_strdup(name), *best = NULL;
	const char *middle = copy + strlen(copy) / 2;

	for (char *blank = strchr(copy, ' '); blank; blank = strchr(blank + 1, ' '))
		if (!best || labs(blank - middle) < labs(best - middle))
			best = blank;
	if (best)
		*best = '\n';
	return copy;
}

static void set_low(struct panel_list *list, bool low)
{
	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		each->least = low ? each->low : each->line;
	}
	list->low = low;
}

/* Writes the headings in one line, or in two. */
static void show_headings(struct panel_list *list)
{
	for (guint i = 0; i < list->columns->len; i++) {
		GtkColumnViewColumn *column = g_array_index(list->columns, struct panel_column, i).column;
		const char *title = gtk_column_view_column_get_title(column);
		char *line = g_strdelimit(g_strdup(title ? title : ""), "\n", ' ');
		char *next = list->low ? two_lines(line) : g_strdup(line);

		if (g_strcmp0(title ? title : "", next) != 0)
			gtk_column_view_column_set_title(column, next);
		g_free(line);
		g_free(next);
	}
}

/* ---- columns that leave ---- */

static bool has_focus(struct panel_list *list, const struct panel_column *column)
{
	int field;

	return cells_focused(list->view, &field) && field == column->field;
}

/* The next column to leave; NULL: none. @empty: only one without any text. */
static struct panel_column *next_to_leave(struct panel_list *list, bool empty)
{
	struct panel_column *next = NULL;

	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		if (each->leaves && !each->away && each->chosen == FREE &&
		    (!next || each->leaves < next->leaves) &&
		    !(empty && *longest(list, each->field)) && !has_focus(list, each))
			next = each;
	}
	return next;
}

static void come_back(struct panel_list *list)
{
	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		each->away = each->leaves && each->chosen == HIDDEN;
	}
}

/* Columns leave while texts are cut, those without any text first. Returns what those that stay
 * need. */
static struct widths leave(struct panel_list *list)
{
	struct panel_column *next = NULL;
	struct widths of;

	do {
		of = widths_of(list);
		if (list->page == 0 || of.all - of.slack <= list->page)
			break;
		next = next_to_leave(list, true);
		if (!next)
			next = next_to_leave(list, false);
		if (next)
			next->away = true;
	} while (next);
	return of;
}

static GAction *action_of(struct panel_list *list, const struct panel_column *column)
{
	char name[16];

	g_snprintf(name, sizeof(name), "text%d", column->field);
	return g_action_map_lookup_action(G_ACTION_MAP(list->actions), name);
}

/* Hides those that left, shows those that came back. The button is there while there is something
 * to choose. */
static void show_columns(struct panel_list *list)
{
	bool choice = false;

	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		if (!each->leaves)
			continue;
		list_show_column(each->column, !each->away);
		g_simple_action_set_state(G_SIMPLE_ACTION(action_of(list, each)),
					  g_variant_new_boolean(!each->away));
		choice = choice || each->away || each->chosen != FREE;
	}
	if (list->button)
		gtk_widget_set_visible(list->button, choice);
}

static void fit(struct panel_list *list);

static void column_chosen(GSimpleAction *action, GVariant *unused, struct panel_list *list)
{
	(void)unused;
	for (guint i = 0; list->columns && i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		if (each->leaves && action_of(list, each) == G_ACTION(action))
			each->chosen = each->away ? SHOWN : HIDDEN;
	}
	if (list->fitted)
		fit(list);
}

static void may_leave(struct panel_list *list, struct panel_column *column, GMenu *menu)
{
	const char *title = gtk_column_view_column_get_title(column->column);
	char *name = g_strdup_printf("text%d", column->field);
	char *detailed = g_strconcat("columns.", name, NULL);
	char *line = g_strdelimit(g_strdup(title), "\n", ' ');
	GSimpleAction *action = g_simple_action_new_stateful(name, NULL, g_variant_new_boolean(TRUE));

	g_signal_connect(action, "activate", G_CALLBACK(column_chosen), list);
	g_action_map_add_action(G_ACTION_MAP(list->actions), G_ACTION(action));
	g_menu_append(menu, line, detailed);
	g_object_unref(action);
	g_free(line);
	g_free(detailed);
	g_free(name);
}

void panel_list_may_leave(struct panel_list *list, const int *texts, int count,
			  GtkMenuButton *button)
{
	GMenu *menu = g_menu_new();

	list->actions = g_simple_action_group_new();
	gtk_widget_insert_action_group(GTK_WIDGET(list->view), "columns", G_ACTION_GROUP(list->actions));
	gtk_widget_insert_action_group(GTK_WIDGET(button), "columns", G_ACTION_GROUP(list->actions));
	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);

		for (int j = 0; j < count; j++)
			if (texts[j] == each->field)
				each->leaves = j + 1;
		if (each->leaves)
			may_leave(list, each, menu);
	}
	for (guint i = 0; i < list->columns->len; i++)
		gtk_column_view_column_set_header_menu(
			g_array_index(list->columns, struct panel_column, i).column, G_MENU_MODEL(menu));
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	gtk_widget_set_visible(GTK_WIDGET(button), FALSE);
	g_set_weak_pointer(&list->button, GTK_WIDGET(button));
	g_object_unref(menu);
}

/* The widgets may keep the actions a little longer. */
static void forget_actions(struct panel_list *list)
{
	for (guint i = 0; list->actions && i < list->columns->len; i++) {
		const struct panel_column *each =
			&g_array_index(list->columns, struct panel_column, i);

		if (each->leaves)
			g_signal_handlers_disconnect_by_data(action_of(list, each), list);
	}
	g_clear_object(&list->actions);
}

/* Each column has the width that it wishes, or more for its texts; room that is left then goes to
 * texts that are cut. Where that is more than the list has, or the texts of one that expands lack room, all give up what their texts do not need,
 * then headings have two lines, then columns leave. If then all headings can be seen where long
 * texts end in an ellipsis, they do. */
static void fit(struct panel_list *list)
{
	struct widths of;
	int over = 0, cut = 0, more = 0;

	measure(list);
	set_low(list, false);
	come_back(list);
	of = widths_of(list);
	if (list->page > 0 && of.all - of.slack > list->page) {
		set_low(list, true);
		of = widths_of(list);
	}
	if (list->actions) {
		of = leave(list);
		show_columns(list);
	}
	if (list->page > 0) {
		over = CLAMP(of.all + of.lack - list->page, 0, of.slack);
		cut = MAX(of.all - of.slack - of.gives - list->page, 0);
		if (cut > of.spare)
			cut = 0;
		more = CLAMP(list->page - of.all - of.lack, 0, of.cut);
	}
	show_headings(list);
	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);
		const int now = list_column_width(each->column);
		const int less = share(slack_of(each), over, of.slack) +
				 share(spare_of(each), cut, of.spare);
		const int grown = of.cut > 0 ? (int)((gint64)cut_of(each) * more / of.cut) : 0;

		if (!each->width || now != each->set || each->away)
			continue;
		each->set = wish_of(each) - less + grown;
		if (each->set != now)
			list_set_column_width(each->column, each->set);
	}
}

static gboolean fit_now(gpointer data)
{
	struct panel_list *list = data;

	list->fit = 0;
	if (list->fitted)
		fit(list);
	return G_SOURCE_REMOVE;
}

/* Not now: the list is just being allocated. */
static void page_changed(GtkAdjustment *across, struct panel_list *list)
{
	const int page = (int)gtk_adjustment_get_page_size(across);

	if (page == list->page)
		return;
	list->page = page;
	if (!list->fit)
		list->fit = g_idle_add_full(G_PRIORITY_HIGH_IDLE, fit_now, list, NULL);
}

static void across_changed(struct panel_list *list)
{
	GtkAdjustment *across = gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(list->view));

	if (list->across)
		g_signal_handlers_disconnect_by_data(list->across, list);
	g_set_object(&list->across, across);
	if (across)
		g_signal_connect(across, "changed", G_CALLBACK(page_changed), list);
}

static int heading_room(struct panel_list *list, const char *name)
{
	return panel_heading_width(GTK_WIDGET(list->view), name) + HEADING_ROOM + ARROW_ROOM;
}

GtkColumnViewColumn *panel_list_add(struct panel_list *list, const char *name, int text,
				    unsigned int flags, int width,
				    GtkListItemFactory *factory)
{
	GtkColumnViewColumn *column = gtk_column_view_column_new(name, factory);
	GtkCustomSorter *sorter = gtk_custom_sorter_new(flags & PANEL_ICON ? by_tone :
		flags & PANEL_NUMBER ? by_number : by_text, GINT_TO_POINTER(text), NULL);
	const int button = flags & PANEL_LIVE ? width : flags & PANEL_BUTTON ? ARROW_LEAST : 0;
	const int least = flags & PANEL_ICON ? ICON_ROOM : MAX(heading_room(list, name), button);
	char *broken = two_lines(name);
	const int low = flags & PANEL_ICON ? ICON_ROOM : MAX(heading_room(list, broken), button);
	const struct panel_column of = { .column = column,
		.text = width || flags & PANEL_EXPAND ? text : -1,
		.room = flags & PANEL_LABEL ? LABEL_ROOM : flags & PANEL_BUTTON ? BUTTON_ROOM :
			CELL_ROOM,
		.bold = flags & PANEL_BOLD, .width = width ? MAX(width, least) : 0, .least = least, .line = least,
		.low = low, .set = MAX(width, least),
		.field = flags & PANEL_ICON ? -1 : text };

	gtk_column_view_column_set_sorter(column, GTK_SORTER(sorter));
	gtk_column_view_column_set_expand(column, flags & PANEL_EXPAND);
	gtk_column_view_column_set_resizable(column, !(flags & PANEL_ICON));
	if (width)
		gtk_column_view_column_set_fixed_width(column, of.set);
	gtk_column_view_append_column(list->view, column);
	if (list->columns)
		g_array_append_val(list->columns, of);
	g_free(broken);
	g_object_unref(sorter);
	g_object_unref(column);
	return column;
}

GtkColumnViewColumn *panel_list_column(struct panel_list *list, const char *name,
				       int text, unsigned int flags, int width)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	const bool icon = flags & PANEL_ICON;

	g_signal_connect(factory, "setup", G_CALLBACK(icon ? setup_icon :
			 flags & PANEL_MIDDLE ? setup_middle : setup_label),
			 GINT_TO_POINTER(text));
	g_signal_connect(factory, "bind", G_CALLBACK(icon ? bind_icon : bind_label), NULL);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), NULL);
	return panel_list_add(list, name, text, flags | PANEL_LABEL, width, factory);
}

/* ---- the list ---- */

static gboolean is_wanted(gpointer item, gpointer data)
{
	const struct panel_list *list = data;

	return panel_row_matches(item, list->wanted);
}

void panel_list_init(struct panel_list *list, GtkColumnView *view)
{
	GtkSortListModel *sorted;

	list->view = view;
	g_set_weak_pointer(&list->fitted, view); /* it may go before panel_list_clear() */
	list->columns = g_array_new(FALSE, TRUE, sizeof(struct panel_column));
	list->wanted = g_strdup("");
	list->store = g_list_store_new(LADDER_TYPE_PANEL_ROW);
	list->filter = gtk_custom_filter_new(is_wanted, list, NULL);
	list->filtered = gtk_filter_list_model_new(g_object_ref(G_LIST_MODEL(list->store)),
						   g_object_ref(GTK_FILTER(list->filter)));
	sorted = gtk_sort_list_model_new(g_object_ref(G_LIST_MODEL(list->filtered)),
					 g_object_ref(gtk_column_view_get_sorter(view)));
	list->selection = gtk_single_selection_new(G_LIST_MODEL(sorted));
	gtk_single_selection_set_autoselect(list->selection, FALSE);
	gtk_single_selection_set_can_unselect(list->selection, TRUE);
	gtk_column_view_set_model(view, GTK_SELECTION_MODEL(list->selection));
	g_signal_connect_swapped(view, "notify::hadjustment", G_CALLBACK(across_changed), list);
	across_changed(list);
}

void panel_list_follow(struct panel_list *list, GCallback changed, gpointer owner)
{
	list->followed = g_signal_connect_swapped(list->selection, "notify::selected-item",
						  changed, owner);
}

void panel_list_clear(struct panel_list *list)
{
	g_clear_handle_id(&list->fit, g_source_remove);
	if (list->selection)
		g_clear_signal_handler(&list->followed, list->selection);
	if (list->across)
		g_signal_handlers_disconnect_by_data(list->across, list);
	g_clear_object(&list->across);
	if (list->fitted)
		g_signal_handlers_disconnect_by_data(list->fitted, list);
	g_clear_weak_pointer(&list->fitted);
	g_clear_weak_pointer(&list->button);
	forget_actions(list);
	g_clear_pointer(&list->columns, g_array_unref);
	g_clear_object(&list->selection);
	g_clear_object(&list->filtered);
	g_clear_object(&list->filter);
	g_clear_object(&list->store);
	g_clear_pointer(&list->wanted, g_free);
}

void panel_list_unsort(struct panel_list *list)
{
	GListModel *columns = gtk_column_view_get_columns(list->view);

	for (guint i = 0; i < g_list_model_get_n_items(columns); i++) {
		GtkColumnViewColumn *column = g_list_model_get_item(columns, i);

		gtk_column_view_column_set_sorter(column, NULL);
		g_object_unref(column);
	}
	for (guint i = 0; i < list->columns->len; i++) {
		struct panel_column *each = &g_array_index(list->columns, struct panel_column, i);
		const char *title = gtk_column_view_column_get_title(each->column);
		const int arrow = title && *title ? ARROW_ROOM : 0;

		each->least -= arrow;
		each->line -= arrow;
		each->low -= arrow;
	}
}

void panel_list_want(struct panel_list *list, const char *wanted)
{
	if (g_strcmp0(list->wanted, wanted) == 0)
		return;
	g_free(list->wanted);
	list->wanted = g_strdup(wanted);
	gtk_filter_changed(GTK_FILTER(list->filter), GTK_FILTER_CHANGE_DIFFERENT);
}

void panel_list_update(struct panel_list *list, GPtrArray *rows)
{
	panel_rows_update(list->store, rows);
	fit(list);
	list_mend_focus(GTK_WIDGET(list->view));
}

LadderPanelRow *panel_list_row(struct panel_list *list)
{
	return gtk_single_selection_get_selected_item(list->selection);
}

void panel_list_go(struct panel_list *list, guint at)
{
	gtk_single_selection_set_selected(list->selection, at);
	if (at != GTK_INVALID_LIST_POSITION)
		list_scroll_to(GTK_WIDGET(list->view), at);
}

bool panel_list_select(struct panel_list *list,
		       bool (*is)(const LadderPanelRow *row, gconstpointer what),
		       gconstpointer what)
{
	GListModel *model = G_LIST_MODEL(list->selection);

	for (guint i = 0; i < g_list_model_get_n_items(model); i++) {
		LadderPanelRow *row = g_list_model_get_item(model, i);
		const bool found = is(row, what);

		g_object_unref(row);
		if (!found)
			continue;
		panel_list_go(list, i);
		return true;
	}
	return false;
}

void panel_go_to(GtkWidget *from, const LadderPanelRow *row)
{
	if (!row)
		return;
	if (row->table >= 0)
		gtk_widget_activate_action(from, "win.go-to", "(iiii)", -1, -1, row->table,
					   row->index);
	else
		gtk_widget_activate_action(from, "win.go-to", "(iiii)", row->pou, row->rung,
					   row->row, row->col);
}

GtkWidget *panel_button_new(const char *icon, const char *name, const char *action)
{
	GtkWidget *button = gtk_button_new_from_icon_name(icon);

	gtk_widget_add_css_class(button, "flat");
	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
	tip_set(button, name);
	spoken_name(button, name);
	return button;
}

void panel_choose_beside(GtkFileChooserNative *chooser, LadderDocument *document)
{
	char *place = ladder_document_folder(document);
	GFile *folder = place ? g_file_new_for_path(place) : NULL;

	if (folder)
		gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(chooser), folder,
						    NULL);
	g_clear_object(&folder);
	g_free(place);
}

/* ---- messages ---- */

void panel_message_init(struct panel_message *message, GtkLabel *label)
{
	GtkWidget *widget = GTK_WIDGET(label);

	*message = (struct panel_message){ .label = label };
	gtk_label_set_xalign(label, 0);
	gtk_label_set_wrap(label, TRUE);
	gtk_widget_add_css_class(widget, "error");
	gtk_widget_add_css_class(widget, "panel-message");
	spoken_text(label);
}

void panel_message_set(struct panel_message *message, LadderDocument *document, char *text)
{
	message->told_of = document ? ladder_document_version(document) : 0;
	gtk_label_set_text(message->label, text ? text : "");
	g_free(text);
}

void panel_message_age(struct panel_message *message, LadderDocument *document)
{
	if (document && ladder_document_version(document) != message->told_of)
		panel_message_set(message, document, NULL);
}

/* ---- the document ---- */

#define REFRESH_MS 100

struct panel_watch {
	GtkWidget *owner;
	void (*refresh)(GtkWidget *owner);
	LadderDocument *document;
	GSignalGroup *group;
	guint timer;
	bool dirty;
	gulong respelled;
};

static void refresh(struct panel_watch *watch)
{
	g_clear_handle_id(&watch->timer, g_source_remove);
	watch->dirty = false;
	watch->refresh(watch->owner);
}

static gboolean elapsed(gpointer data)
{
	struct panel_watch *watch = data;

	watch->timer = 0;
	if (watch->dirty && gtk_widget_get_mapped(watch->owner))
		refresh(watch);
	return G_SOURCE_REMOVE;
}

static void changed(struct panel_watch *watch)
{
	watch->dirty = true;
	if (!watch->timer && gtk_widget_get_mapped(watch->owner))
		watch->timer = g_timeout_add(REFRESH_MS, elapsed, watch);
}

static void rungs_changed(LadderDocument *document, int pou, int at, int removed,
			  int inserted, gpointer watch)
{
	(void)document;
	(void)pou;
	(void)at;
	(void)removed;
	(void)inserted;
	changed(watch);
}

static void list_changed(LadderDocument *document, int pou, gpointer watch)
{
	(void)document;
	(void)pou;
	changed(watch);
}

static void variable_changed(LadderDocument *document, int pou, const char *name,
			     const char *address, gpointer watch)
{
	(void)document;
	(void)pou;
	(void)name;
	(void)address;
	changed(watch);
}

static void whole_changed(LadderDocument *document, gpointer watch)
{
	(void)document;
	changed(watch);
}

static void seen(GtkWidget *owner, gpointer data)
{
	struct panel_watch *watch = data;

	(void)owner;
	if (watch->dirty)
		refresh(watch);
}

struct panel_watch *panel_watch_new(GtkWidget *owner, bool checks,
				    void (*refresh_panel)(GtkWidget *owner))
{
	struct panel_watch *watch = g_new0(struct panel_watch, 1);

	watch->owner = owner;
	watch->refresh = refresh_panel;
	watch->group = g_signal_group_new(LADDER_TYPE_DOCUMENT);
	g_signal_group_connect(watch->group, "project-changed", G_CALLBACK(whole_changed),
			       watch);
	g_signal_group_connect(watch->group, "rungs-changed", G_CALLBACK(rungs_changed),
			       watch);
	g_signal_group_connect(watch->group, "variable-changed",
			       G_CALLBACK(variable_changed), watch);
	g_signal_group_connect(watch->group, "list-changed", G_CALLBACK(list_changed), watch);
	if (checks)
		g_signal_group_connect(watch->group, "checked", G_CALLBACK(whole_changed),
				       watch);
	g_signal_connect_after(owner, "map", G_CALLBACK(seen), watch);
	if (settings_get()) /* addresses get another spelling */
		watch->respelled = g_signal_connect_swapped(settings_get(), "changed::spelling",
							    G_CALLBACK(panel_watch_later), watch);
	return watch;
}

void panel_watch_free(struct panel_watch *watch)
{
	if (!watch)
		return;
	g_clear_handle_id(&watch->timer, g_source_remove);
	g_signal_handlers_disconnect_by_data(watch->owner, watch);
	if (watch->respelled)
		g_signal_handler_disconnect(settings_get(), watch->respelled);
	g_signal_group_set_target(watch->group, NULL);
	g_clear_object(&watch->group);
	g_clear_object(&watch->document);
	g_free(watch);
}

bool panel_watch_set(struct panel_watch *watch, LadderDocument *document)
{
	if (!g_set_object(&watch->document, document))
		return false;
	g_signal_group_set_target(watch->group, document);
	watch->dirty = true;
	if (gtk_widget_get_mapped(watch->owner))
		refresh(watch);
	return true;
}

LadderDocument *panel_watch_document(struct panel_watch *watch)
{
	return watch ? watch->document : NULL;
}

void panel_watch_later(struct panel_watch *watch)
{
	changed(watch);
}

void panel_watch_now(struct panel_watch *watch)
{
	if (watch->dirty)
		refresh(watch);
}
