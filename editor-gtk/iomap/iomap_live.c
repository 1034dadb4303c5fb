/* SPDX-License-Identifier: MIT
 *
 * iomap_live - present values in the table of an I/O map.
 */
#include "editor-gtk/iomap/iomap_live.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/spelling.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/sim/live_value.h"

#include <string.h>

#define SHOWN   8  /* values in a cell                                       */
#define TESTED  64 /* values to choose from in a test                        */

/* ---- where the values of a row are ---- */

static const char *field_of(const LadderPanelRow *row, enum io_field field)
{
	const int column = iomap_column_of((enum iomap_page)row->table, field);

	return column < 0 ? "" : panel_row_text(row, column);
}

static void add_values(GArray *out, struct iec_addr first, uint32_t count)
{
	for (uint32_t i = 0; i < count && out->len < TESTED; i++) {
		const uint64_t bit = first.bit + (uint64_t)i * first.bits;
		struct iec_addr addr = first;

		addr.byte += (uint32_t)(bit / 8);
		addr.bit = (uint8_t)(bit % 8);
		g_array_append_val(out, addr);
	}
}

/* A module has inputs and outputs of four areas, at the place that its address says. */
static void add_module(GArray *out, uint32_t place)
{
	static const struct { enum iec_area area; uint8_t bits; uint32_t bytes; } part[] = {
		{ AREA_XI, 1, 3 }, { AREA_XQ, 1, 2 }, { AREA_XAI, 16, 16 }, { AREA_XAQ, 16, 16 },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(part); i++) {
		struct iec_addr addr = { .bits = part[i].bits, .byte = place * part[i].bytes };

		addr.area = part[i].area;
		add_values(out, addr, 8 * part[i].bytes / part[i].bits);
	}
}

/* The addresses of a row, of struct iec_addr. Caller: g_array_unref(). */
static GArray *addresses_of(const LadderPanelRow *row)
{
	GArray *out = g_array_new(FALSE, FALSE, sizeof(struct iec_addr));
	const char *text = panel_row_text(row, 0);
	struct io_values values;

	if (row->table == IOMAP_BUSES || !io_values_read(text, strlen(text), &values))
		return out;
	if (g_ascii_strcasecmp(field_of(row, IO_DRIVER), "module") == 0)
		add_module(out, values.first.byte / 3);
	else
		add_values(out, values.first, values.count);
	return out;
}

/* Values have the type that the map says, or the signed one of their width. */
static struct location locate(const LadderPanelRow *row, LadderSim *sim, struct iec_addr addr)
{
	const struct image *image = live_image(sim, false);
	struct location at = image ? image_locate(image, addr) : (struct location){ .type = IEC_NONE };
	const char *as = field_of(row, IO_AS);
	enum iec_type type = iec_type_find(as, strlen(as));

	if (type == IEC_NONE)
		type = addr.bits == 8 ? IEC_USINT : addr.bits == 16 ? IEC_INT :
		       addr.bits == 32 ? IEC_DINT : addr.bits == 64 ? IEC_LINT : IEC_BOOL;
	if (at.type != IEC_NONE && iec_type_row(type)->size == iec_type_row(at.type)->size &&
	    addr.bits > 1)
		at.type = type;
	return at;
}

/* ---- cells ---- */

static LadderPanelRow *row_of(GtkWidget *cell)
{
	GtkListItem *item = g_object_get_data(G_OBJECT(cell), "item");

	return item ? gtk_list_item_get_item(item) : NULL;
}

static void print_value(struct location at, union iec_value value, char *out, gsize size)
{
	if (at.type == IEC_BOOL)
		g_snprintf(out, size, "%d", value.i != 0);
	else
		live_value_print(at.type, value, out, size);
}

/* What the values of a row are besides. */
struct shown {
	bool forced;             /* one of them is                             */
	enum sim_quality worst;
};

/* "1 0 0 1 …". Caller: g_free(). */
static char *values_of(LadderSim *sim, const LadderPanelRow *row, struct shown *shown)
{
	GArray *all = addresses_of(row);
	GString *text = g_string_new(NULL);

	for (guint i = 0; i < all->len; i++) {
		const struct location at = locate(row, sim, g_array_index(all, struct iec_addr, i));
		struct live_seen seen = { .known = false };
		char value[IEC_VALUE_TEXT] = "";

		if (at.type == IEC_NONE)
			continue;
		live_value_look_outside(&seen, sim, false, at);
		shown->forced = shown->forced || (seen.known && seen.forced);
		shown->worst = MAX(shown->worst, seen.quality);
		if (i > SHOWN)
			continue;
		if (seen.known)
			print_value(at, seen.value, value, sizeof(value));
		g_string_append_printf(text, "%s%s", text->len ? " " : "",
				       i == SHOWN ? "…" : seen.known ? value : "?");
	}
	g_array_unref(all);
	return g_string_free(text, FALSE);
}

static void show_cell(struct iomap_live *live, GtkWidget *cell)
{
	LadderPanelRow *row = row_of(cell);
	const bool on = live->sim && ladder_sim_is_on(live->sim);
	struct shown shown = { .worst = SIM_GOOD };
	char *values = row && on ? values_of(live->sim, row, &shown) : g_strdup("");
	const char *quality = live_quality_text(shown.worst);
	char *text = g_strdup_printf("%s%s%s", *values ? quality : "", *values && *quality ? "  " : "", values);
	char *name;

	style_set(cell, "bad-quality", shown.worst != SIM_GOOD);
	style_set(cell, "forced", shown.forced);
	if (g_strcmp0(gtk_button_get_label(GTK_BUTTON(cell)), text) != 0 ||
	    !gtk_widget_get_visible(cell)) {
		gtk_button_set_label(GTK_BUTTON(cell), text);
		quality = live_quality_word(shown.worst);
		name = g_strdup_printf("%s, %s: %s%s%s%s%s", row ? panel_row_text(row, 0) : "", _("Value"), values,
				       shown.forced ? ", " : "", shown.forced ? _("forced") : "",
				       *quality ? ", " : "", quality);
		gtk_accessible_update_property(GTK_ACCESSIBLE(cell), GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
		g_free(name);
	}
	gtk_widget_set_visible(cell, *text);
	g_free(text);
	g_free(values);
}

static void show_all(struct iomap_live *live)
{
	for (guint i = 0; i < live->cells->len; i++)
		show_cell(live, live->cells->pdata[i]);
}

/* ---- the test of a point ---- */

/* What the popover shows. */
struct test {
	struct iomap_live *live;
	LadderPanelRow *row;
	GArray *addresses;
	GtkWidget *which, *entry, *why;
	struct location at;     /* of the last act                             */
};

static void test_free(gpointer data)
{
	struct test *test = data;

	g_object_unref(test->row);
	g_array_unref(test->addresses);
	g_free(test);
}

static struct location tested(const struct test *test)
{
	const guint at = test->which ? gtk_drop_down_get_selected(GTK_DROP_DOWN(test->which)) : 0;

	return at >= test->addresses->len ? (struct location){ .type = IEC_NONE } :
	       locate(test->row, test->live->sim, g_array_index(test->addresses, struct iec_addr, at));
}

static void test_says(struct test *test, const char *why)
{
	gtk_label_set_text(GTK_LABEL(test->why), why ? why : "");
	gtk_widget_set_visible(test->why, why != NULL);
}

static void show_tested(struct test *test)
{
	const struct location at = tested(test);
	struct live_seen seen = { .known = false };
	char text[IEC_VALUE_TEXT] = "";

	if (at.type != IEC_NONE)
		live_value_look_outside(&seen, test->live->sim, false, at);
	if (seen.known)
		print_value(at, seen.value, text, sizeof(text));
	gtk_editable_set_text(GTK_EDITABLE(test->entry), text);
	test_says(test, at.type == IEC_NONE ? _("The program has no such address") : NULL);
}

/* Sets or forces what is typed. */
static void act(struct test *test, bool force)
{
	LadderSim *sim = test->live->sim;
	const char *typed = gtk_editable_get_text(GTK_EDITABLE(test->entry));
	const struct location at = tested(test);
	const bool forced = at.type != IEC_NONE && live_value_is_forced(sim, false, at);
	const char *why = ladder_sim_why_not(sim, force || forced ? SIM_WISH_FORCE : SIM_WISH_SET);
	enum diag_id fault = DIAG_COUNT;
	union iec_value value = { .i = 0 };
	struct iec_text room;
	char *said;

	test->at = at;
	if (why || at.type == IEC_NONE) {
		test_says(test, why ? why : _("The program has no such address"));
	} else if (!live_value_parse(FORMAT_AUTO, at.type, typed, &room, &value, &fault)) {
		said = diag_said_of(fault, typed);
		test_says(test, said);
		g_free(said);
	} else {
		test_says(test, NULL);
		if (force)
			live_value_force(sim, false, at, value);
		else
			live_value_set(sim, false, at, value);
	}
}

static void set_clicked(struct test *test)
{
	act(test, false);
}

static void force_clicked(struct test *test)
{
	act(test, true);
}

static void release_clicked(struct test *test)
{
	const struct location at = tested(test);
	const char *why = ladder_sim_why_not(test->live->sim, SIM_WISH_FORCE);

	test->at = at;
	test_says(test, why);
	if (!why && at.type != IEC_NONE)
		live_value_release(test->live->sim, false, at);
}

static GtkWidget *which_new(const struct test *test)
{
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	GtkWidget *which = gtk_drop_down_new(NULL, NULL);

	for (guint i = 0; i < test->addresses->len; i++) {
		char text[24];

		spelling_address(spelling_screen(), g_array_index(test->addresses, struct iec_addr, i), text,
				 sizeof(text));
		g_ptr_array_add(names, g_strdup(text));
	}
	drop_fill(GTK_DROP_DOWN(which), names);
	gtk_accessible_update_property(GTK_ACCESSIBLE(which), GTK_ACCESSIBLE_PROPERTY_LABEL, _("Address"), -1);
	g_ptr_array_unref(names);
	return which;
}

static GtkWidget *button_new(struct test *test, const char *text, GCallback clicked)
{
	GtkWidget *button = gtk_button_new_with_label(text);

	g_signal_connect_swapped(button, "clicked", clicked, test);
	return button;
}

static GtkWidget *test_box(struct test *test)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	GtkWidget *buttons = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	char *text = g_strdup_printf(_("Test of %s"), panel_row_text(test->row, 0));
	GtkWidget *title = gtk_label_new(text);

	gtk_widget_add_css_class(title, "heading");
	gtk_box_append(GTK_BOX(box), title);
	if (test->addresses->len > 1) {
		test->which = which_new(test);
		gtk_box_append(GTK_BOX(box), test->which);
		g_signal_connect_swapped(test->which, "notify::selected", G_CALLBACK(show_tested), test);
	}
	test->entry = gtk_entry_new();
	gtk_accessible_update_property(GTK_ACCESSIBLE(test->entry), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("New value"), -1);
	g_signal_connect_swapped(test->entry, "activate", G_CALLBACK(set_clicked), test);
	gtk_box_append(GTK_BOX(box), test->entry);
	gtk_box_append(GTK_BOX(buttons), button_new(test, _("Set value"), G_CALLBACK(set_clicked)));
	gtk_box_append(GTK_BOX(buttons), button_new(test, _("Force"), G_CALLBACK(force_clicked)));
	gtk_box_append(GTK_BOX(buttons), button_new(test, _("Release force"), G_CALLBACK(release_clicked)));
	gtk_box_append(GTK_BOX(box), buttons);
	test->why = gtk_label_new(NULL);
	gtk_label_set_wrap(GTK_LABEL(test->why), TRUE);
	gtk_label_set_max_width_chars(GTK_LABEL(test->why), 36);
	gtk_widget_add_css_class(test->why, "error");
	gtk_box_append(GTK_BOX(box), test->why);
	g_free(text);
	return box;
}

static void test_closed(GtkWidget *popover)
{
	popover_drop_later(popover);
}

static void open_test(GtkWidget *cell, struct iomap_live *live)
{
	LadderPanelRow *row = row_of(cell);
	GtkWidget *popover;
	struct test *test;

	if (!row || !live->sim || !ladder_sim_is_on(live->sim))
		return;
	test = g_new0(struct test, 1);
	*test = (struct test){ .live = live, .row = g_object_ref(row), .addresses = addresses_of(row) };
	popover = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(popover), test_box(test));
	g_object_set_data_full(G_OBJECT(popover), "test", test, test_free);
	g_signal_connect(popover, "closed", G_CALLBACK(test_closed), NULL);
	g_set_weak_pointer(&live->test, popover);
	popover_put(popover, cell);
	popover_form(popover, cell);
	show_tested(test);
	gtk_popover_popup(GTK_POPOVER(popover));
}

/* ---- the column ---- */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer live)
{
	GtkWidget *cell = gtk_button_new_with_label("");

	gtk_label_set_ellipsize(GTK_LABEL(gtk_button_get_child(GTK_BUTTON(cell))), PANGO_ELLIPSIZE_END);
	(void)factory;
	gtk_widget_add_css_class(cell, "flat");
	gtk_widget_add_css_class(cell, "watch-force");
	gtk_widget_add_css_class(cell, "numeric");
	gtk_widget_set_halign(cell, GTK_ALIGN_START);
	tip_set(cell, _("Test this point…"));
	g_signal_connect(cell, "clicked", G_CALLBACK(open_test), live);
	gtk_list_item_set_child(item, cell);
}

static void row_changed(LadderPanelRow *row, GtkWidget *cell)
{
	(void)row;
	show_cell(g_object_get_data(G_OBJECT(cell), "live"), cell);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	struct iomap_live *live = data;
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "item", item);
	g_object_set_data(G_OBJECT(cell), "live", live);
	g_ptr_array_add(live->cells, cell);
	g_signal_connect(gtk_list_item_get_item(item), "changed", G_CALLBACK(row_changed), cell);
	show_cell(live, cell);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	struct iomap_live *live = data;
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	g_signal_handlers_disconnect_by_data(gtk_list_item_get_item(item), cell);
	g_object_set_data(G_OBJECT(cell), "item", NULL);
	if (live->cells)
		g_ptr_array_remove_fast(live->cells, cell);
}

void iomap_live_add(struct iomap_live *live, struct panel_list *list)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GtkColumnViewColumn *column;

	g_signal_connect(factory, "setup", G_CALLBACK(setup), live);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), live);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), live);
	column = panel_list_add(list, _("Value"), IOMAP_VALUE, PANEL_LIVE, 104, factory);
	list_show_column(column, false);
	g_ptr_array_add(live->columns, column);
}

/* ---- the simulation ---- */

static struct iomap_live *live_of(GObject *owner)
{
	return g_object_get_data(owner, "live");
}

static void shown(GObject *owner)
{
	if (live_of(owner)->cells)
		show_all(live_of(owner));
}

static void state_changed(GObject *owner)
{
	struct iomap_live *live = live_of(owner);
	const bool on = live->sim && ladder_sim_is_on(live->sim);

	if (!live->cells)
		return; /* the owner is disposed */
	for (guint i = 0; i < live->columns->len; i++)
		list_show_column(live->columns->pdata[i], on);
	if (!on && live->test)
		gtk_popover_popdown(GTK_POPOVER(live->test));
	show_all(live);
}

/* The board did not do what a person did in the test. */
static void refused(GObject *owner, const struct location *at, const char *why)
{
	struct iomap_live *live = live_of(owner);
	struct test *test = live->test ? g_object_get_data(G_OBJECT(live->test), "test") : NULL;

	if (test && live_value_is_same(test->at, *at))
		test_says(test, why);
}

void iomap_live_follow(struct iomap_live *live, LadderSim *sim, GObject *owner)
{
	if (live->sim)
		return;
	live->sim = g_object_ref(sim);
	g_object_set_data(owner, "live", live);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), owner, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(shown), owner, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(state_changed), owner, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "refused", G_CALLBACK(refused), owner, G_CONNECT_SWAPPED);
	state_changed(owner);
}

void iomap_live_init(struct iomap_live *live)
{
	*live = (struct iomap_live){ .cells = g_ptr_array_new(), .columns = g_ptr_array_new() };
}

void iomap_live_clear(struct iomap_live *live)
{
	g_clear_weak_pointer(&live->test);
	g_clear_pointer(&live->cells, g_ptr_array_unref);
	g_clear_pointer(&live->columns, g_ptr_array_unref);
	g_clear_object(&live->sim);
}
