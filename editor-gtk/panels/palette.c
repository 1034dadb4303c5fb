/* SPDX-License-Identifier: MIT
 *
 * palette - the palette of elements and blocks; see palette.h.
 */
#include "editor-gtk/panels/palette.h"

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/sfc_icon.h"
#include "editor-gtk/fbd/fbd_view.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/panels/tile.h"
#include "editor-gtk/sfc/sfc_view.h"

#include "engine/base/name.h"

#include <string.h>

#define LADDER_TYPE_PALETTE (ladder_palette_get_type())
G_DECLARE_FINAL_TYPE(LadderPalette, ladder_palette, LADDER, PALETTE, GtkBox)

/* How well a word fits the search text: equal, begins with it, its explanation contains it. */
enum rank { RANK_IS, RANK_BEGINS, RANK_TOLD, RANK_NONE };

/* A tile: the word or the tool of a chart that it places. */
struct offer {
	int id;                     /* enum word, or enum sfc_tool               */
	bool box;                   /* of networks: it is dragged there          */
	const struct word_row *row; /* NULL: a tool of a chart. Of a word of the project: as long
				       as it is shown */
	GArray *more;               /* of struct offer: its kinds for other types; or NULL */
};

struct _LadderPalette {
	GtkBox parent;
	LadderDocument *document;
	GtkWidget *search, *families;
	enum palette_kind kind;
	int own;                    /* number of words of the project shown    */
	bool stale;                 /* hidden, with rows of a project before    */
	struct offer best;          /* best match of the search                */
	enum rank rank;             /* how well it fits                        */
};

G_DEFINE_FINAL_TYPE(LadderPalette, ladder_palette, GTK_TYPE_BOX)

/* ---- tiles ---- */

static const char *name_of(const struct word_row *row)
{
	return row->word[0] ? row->word : explain_id(row);
}

/* The key that enters this word. Caller frees. */
static char *key_of_word(enum word word)
{
	static const struct { enum word word; enum verb verb; } keys[] = {
		{ ELEM_CONTACT_NO, VERB_contact }, { ELEM_CONTACT_NC, VERB_contact_not },
		{ ELEM_COIL, VERB_coil },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(keys); i++)
		if (keys[i].word == word)
			return verb_keys_label(keys[i].verb);
	return g_strdup("");
}

static void draw_word(const struct tile *tile, const struct theme *theme,
		      struct lettering *lettering, float width, float height,
		      struct picture *picture)
{
	grid_draw_icon(tile->of, theme, lettering, width, height, picture);
}

static void draw_tool(const struct tile *tile, const struct theme *theme,
		      struct lettering *lettering, float width, float height,
		      struct picture *picture)
{
	sfc_icon_draw((enum sfc_tool)tile->id, theme, lettering, width, height, picture);
}

static GdkContentProvider *drag_word(int word)
{
	return ladder_grid_view_drag((enum word)word);
}

static GdkContentProvider *drag_box(int word)
{
	return ladder_fbd_view_drag(word);
}

static GtkWidget *word_tile(const struct offer *offer)
{
	char *key = offer->box ? g_strdup("") : key_of_word((enum word)offer->id);
	const struct tile tile = {
		.name = name_of(offer->row), .told = said(words_explain(offer->row)),
		.key = key, .draw = draw_word, .of = offer->row, .action = "win.place",
		.drag = offer->box ? drag_box : drag_word, .id = offer->id,
	};
	GtkWidget *widget = tile_new(&tile);

	g_free(key);
	return widget;
}

static GtkWidget *tool_tile(enum sfc_tool tool)
{
	const enum verb verb = sfc_tool_verb(tool);
	char *key = verb == VERB_COUNT ? g_strdup("") : verb_keys_label(verb);
	const struct tile tile = {
		.name = sfc_tool_name(tool), .told = sfc_tool_told(tool), .key = key,
		.draw = draw_tool, .action = "win.place-part", .drag = ladder_sfc_view_drag,
		.id = (int)tool,
	};
	GtkWidget *widget = tile_new(&tile);

	g_free(key);
	return widget;
}

static GMenu *menu_of(GArray *more)
{
	GMenu *menu = g_menu_new();

	for (guint i = 0; i < more->len; i++) {
		const struct offer *offer = &g_array_index(more, struct offer, i);
		/* one "_" would mark a letter as the key of the entry */
		char **parts = g_strsplit(name_of(offer->row), "_", -1);
		char *label = g_strjoinv("__", parts);
		GMenuItem *item = g_menu_item_new(label, NULL);

		g_menu_item_set_action_and_target(item, "win.place", "i", offer->id);
		g_menu_append_item(menu, item);
		g_object_unref(item);
		g_free(label);
		g_strfreev(parts);
	}
	return menu;
}

static GtkWidget *tile_of(const struct offer *offer)
{
	GtkWidget *tile = offer->row ? word_tile(offer) : tool_tile((enum sfc_tool)offer->id);

	return offer->more ? tile_with(tile, name_of(offer->row), menu_of(offer->more)) : tile;
}

/* ---- families ---- */

static bool has(const char *search, ...) G_GNUC_NULL_TERMINATED;

/* Is @search in one of the texts? */
static bool has(const char *search, ...)
{
	char *want = g_utf8_casefold(search, -1);
	bool found = !want[0];
	const char *text;
	va_list texts;

	va_start(texts, search);
	while (!found && (text = va_arg(texts, const char *)) != NULL) {
		char *fold = g_utf8_casefold(text, -1);

		found = strstr(fold, want);
		g_free(fold);
	}
	va_end(texts);
	g_free(want);
	return found;
}

static bool fits(const struct word_row *row, const char *search)
{
	return has(search, row->word, explain_id(row), explain_family(row), words_explain(row),
		   said(explain_family(row)), said(words_explain(row)), NULL);
}

static bool is_offered(const struct word_row *row)
{
	return *explain_family(row) && row->place != PLACE_NONE &&
	       row->place != PLACE_PIN && row->kind != WORD_STRUCT;
}

static void offer_clear(gpointer offer)
{
	g_clear_pointer(&((struct offer *)offer)->more, g_array_unref);
}

static GArray *offers_new(void)
{
	GArray *offers = g_array_new(FALSE, FALSE, sizeof(struct offer));

	g_array_set_clear_func(offers, offer_clear);
	return offers;
}

/* Tiles are made when their family is opened: they are most of the window's widgets. Those of a closed one are in no
 * window; GTK 4.8 would give them the focus all the same, backwards from what is behind the family. */
static void make_tiles(GtkExpander *expander)
{
	GArray *offers = g_object_get_data(G_OBJECT(expander), "offers");

	gtk_widget_set_can_focus(gtk_expander_get_child(expander), gtk_expander_get_expanded(expander));
	if (!gtk_expander_get_expanded(expander))
		return;
	for (guint i = 0; i < offers->len; i++) {
		const struct offer *offer = &g_array_index(offers, struct offer, i);
		GtkWidget *child = gtk_flow_box_child_new();

		gtk_flow_box_child_set_child(GTK_FLOW_BOX_CHILD(child), tile_of(offer));
		gtk_widget_set_focusable(child, FALSE);
		spoken_name(child, offer->row ? name_of(offer->row) :
			    sfc_tool_name((enum sfc_tool)offer->id));
		gtk_flow_box_append(GTK_FLOW_BOX(gtk_expander_get_child(expander)), child);
	}
	g_array_set_size(offers, 0);
}

static GtkWidget *family_new(const char *name)
{
	GtkWidget *expander = gtk_expander_new(NULL);
	GtkWidget *flow = gtk_flow_box_new();
	/* The expander has the name for a screen reader. */
	GtkWidget *label = g_object_new(GTK_TYPE_LABEL, "label", name, "accessible-role",
					GTK_ACCESSIBLE_ROLE_NONE, NULL);

	gtk_expander_set_label_widget(GTK_EXPANDER(expander), label);
	gtk_flow_box_set_selection_mode(GTK_FLOW_BOX(flow), GTK_SELECTION_NONE);
	gtk_flow_box_set_min_children_per_line(GTK_FLOW_BOX(flow), 2);
	gtk_flow_box_set_max_children_per_line(GTK_FLOW_BOX(flow), 8);
	gtk_flow_box_set_homogeneous(GTK_FLOW_BOX(flow), TRUE);
	gtk_expander_set_child(GTK_EXPANDER(expander), flow);
	g_object_set_data_full(G_OBJECT(expander), "offers", offers_new(),
			       (GDestroyNotify)g_array_unref);
	gtk_widget_set_can_focus(flow, FALSE);
	g_signal_connect(expander, "notify::expanded", G_CALLBACK(make_tiles), NULL);
	gtk_widget_add_css_class(expander, "family");
	spoken_name(expander, name);
	spoken_name(flow, name);
	return expander;
}

/* Families that are open at first. */
static bool is_common(const char *family)
{
	static const char *const common[] = {
		"Contacts", "Coils", "Timers", "Counters", "Steps", "Transitions", "Actions",
	};

	for (gsize i = 0; i < G_N_ELEMENTS(common); i++)
		if (strcmp(family, common[i]) == 0)
			return true;
	return false;
}

static enum rank rank_of(const char *word, const char *search)
{
	const gsize len = strlen(search);

	if (!name_begins(search, len, word, strlen(word)))
		return RANK_TOLD;
	return name_is(word, search, len) ? RANK_IS : RANK_BEGINS;
}

static const char *search_of(const LadderPalette *palette)
{
	return gtk_editable_get_text(GTK_EDITABLE(palette->search));
}

/* The offers of a family, which is made for the first of them. */
static GArray *offers_of(LadderPalette *palette, GHashTable *families, const char *name)
{
	GtkWidget *family = g_hash_table_lookup(families, name);

	if (!family) {
		family = family_new(_(name));
		gtk_box_append(GTK_BOX(palette->families), family);
		g_hash_table_insert(families, (gpointer)name, family);
	}
	return g_object_get_data(G_OBJECT(family), "offers");
}

/* CTU of CTU_DINT: the block of which @row is the kind for another type. NULL: none. */
static struct offer *kind_of(GArray *offers, const struct word_row *row)
{
	const char *under = strrchr(row->word, '_');
	const gsize len = under ? (gsize)(under - row->word) : 0;

	if (!under || row->kind != WORD_FB ||
	    iec_type_find(under + 1, strlen(under + 1)) == IEC_NONE)
		return NULL;
	for (guint i = 0; i < offers->len; i++) {
		struct offer *offer = &g_array_index(offers, struct offer, i);

		if (strlen(offer->row->word) == len &&
		    strncmp(offer->row->word, row->word, len) == 0)
			return offer;
	}
	return NULL;
}

static void add_offer(LadderPalette *palette, GHashTable *families, const char *family,
		      const struct offer *offer)
{
	const char *search = search_of(palette);
	const enum rank fit = rank_of(offer->row ? name_of(offer->row) :
				      sfc_tool_name((enum sfc_tool)offer->id), search);
	GArray *offers = offers_of(palette, families, family);
	/* A search shows every kind that fits. */
	struct offer *of = offer->row && !search[0] ? kind_of(offers, offer->row) : NULL;

	if (of && !of->more)
		of->more = offers_new();
	g_array_append_val(of ? of->more : offers, *offer);
	if (fit < palette->rank) {
		palette->rank = fit;
		palette->best = *offer;
	}
}

static void open_families(GHashTable *families, bool all)
{
	GHashTableIter each;
	gpointer name, family;

	g_hash_table_iter_init(&each, families);
	while (g_hash_table_iter_next(&each, &name, &family))
		if (all || is_common(name))
			gtk_expander_set_expanded(family, TRUE);
}

/* In networks only functions and blocks are boxes. */
static bool is_wanted(const LadderPalette *palette, const struct word_row *row)
{
	return is_offered(row) && (palette->kind != PALETTE_NETWORK || row->kind == WORD_FN || row->kind == WORD_FB) &&
	       fits(row, search_of(palette));
}

static void add_words(LadderPalette *palette, GHashTable *families)
{
	const struct project *project = ladder_document_project(palette->document);
	const bool box = palette->kind == PALETTE_NETWORK;

	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		if (is_wanted(palette, row))
			add_offer(palette, families, explain_family(row), &(struct offer){ i, box, row, NULL });
	}
	palette->own = project ? project->words.count : 0;
	for (int i = 0; i < palette->own; i++) {
		const int word = WORD_FIRST_OWN + i;
		const struct word_row *row = words_row(&project->words, (enum word)word);

		if (is_wanted(palette, row))
			add_offer(palette, families, explain_family(row),
				  &(struct offer){ word, box, row, NULL });
	}
}

static void add_tools(LadderPalette *palette, GHashTable *families)
{
	const char *search = search_of(palette);

	for (int i = 0; i < TOOL_COUNT; i++) {
		const char *family = sfc_tool_family((enum sfc_tool)i);

		if (has(search, sfc_tool_name((enum sfc_tool)i), sfc_tool_told((enum sfc_tool)i),
			_(family), NULL))
			add_offer(palette, families, family, &(struct offer){ i, false, NULL, NULL });
	}
	palette->own = 0;
}

static void fill(LadderPalette *palette)
{
	GHashTable *families = g_hash_table_new(g_str_hash, g_str_equal);
	GtkWidget *family;

	palette->rank = RANK_NONE;
	palette->stale = false;
	while ((family = gtk_widget_get_first_child(palette->families)))
		gtk_box_remove(GTK_BOX(palette->families), family);
	if (palette->kind == PALETTE_CHART)
		add_tools(palette, families);
	else
		add_words(palette, families);
	open_families(families, search_of(palette)[0]);
	g_hash_table_unref(families);
}

static void leave(LadderPalette *palette)
{
	gtk_editable_set_text(GTK_EDITABLE(palette->search), "");
	gtk_widget_activate_action(GTK_WIDGET(palette), "win.to-sheet", NULL);
}

/* Uses the text in the entry: "search-changed" comes with a delay. */
static void place_best(LadderPalette *palette)
{
	struct offer best;

	if (!search_of(palette)[0])
		return;
	fill(palette);
	if (palette->rank == RANK_NONE)
		return;
	best = palette->best; /* placing changes palette->best               */
	gtk_editable_set_text(GTK_EDITABLE(palette->search), "");
	gtk_widget_activate_action(GTK_WIDGET(palette), best.row ? "win.place" :
				   "win.place-part", "i", best.id);
}

/* Rows of words of the project are freed with it. Nobody reads those of a hidden palette: who types a text
 * does not wait for it. */
static void project_changed(LadderPalette *palette)
{
	const struct project *project = ladder_document_project(palette->document);

	if ((palette->kind != PALETTE_LADDER && palette->kind != PALETTE_NETWORK) ||
	    (palette->own == 0 && (!project || project->words.count == 0)))
		return;
	palette->stale = true;
	if (gtk_widget_get_mapped(GTK_WIDGET(palette)))
		fill(palette);
}

static void shown(LadderPalette *palette)
{
	if (palette->stale)
		fill(palette);
}

static void ladder_palette_finalize(GObject *object)
{
	g_object_unref(LADDER_PALETTE(object)->document);
	G_OBJECT_CLASS(ladder_palette_parent_class)->finalize(object);
}

static void ladder_palette_class_init(LadderPaletteClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_palette_finalize;
}

static void ladder_palette_init(LadderPalette *palette)
{
	GtkWidget *scroller = gtk_scrolled_window_new();

	gtk_orientable_set_orientation(GTK_ORIENTABLE(palette), GTK_ORIENTATION_VERTICAL);
	palette->search = gtk_search_entry_new();
	palette->families = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
	gtk_widget_set_margin_start(palette->search, 10);
	gtk_widget_set_margin_end(palette->search, 10);
	gtk_widget_set_margin_top(palette->search, 6);
	gtk_search_entry_set_key_capture_widget(GTK_SEARCH_ENTRY(palette->search), NULL);
	g_object_set(palette->search, "placeholder-text", _("Find an element"), NULL);
	spoken_name(palette->search, _("Find an element"));
	spoken_name(scroller, _("Elements"));
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), palette->families);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(palette), palette->search);
	gtk_box_append(GTK_BOX(palette), scroller);
	g_signal_connect_swapped(palette->search, "search-changed", G_CALLBACK(fill),
				 palette);
	g_signal_connect_swapped(palette->search, "activate", G_CALLBACK(place_best),
				 palette);
	g_signal_connect_swapped(palette->search, "stop-search", G_CALLBACK(leave),
				 palette);
}

bool ladder_palette_find(GtkWidget *palette)
{
	return gtk_widget_is_visible(palette) &&
	       gtk_widget_grab_focus(LADDER_PALETTE(palette)->search);
}

void ladder_palette_show(GtkWidget *widget, enum palette_kind kind)
{
	LadderPalette *palette = LADDER_PALETTE(widget);
	const char *prompt = kind == PALETTE_CHART ? _("Find a part of a chart") :
			     kind == PALETTE_NETWORK ? _("Find a box") : _("Find an element");

	/* the still picture around it would keep the room */
	gtk_widget_set_visible(gtk_widget_get_parent(widget), kind != PALETTE_NONE);
	if (kind == PALETTE_NONE || kind == palette->kind)
		return;
	palette->kind = kind;
	gtk_editable_set_text(GTK_EDITABLE(palette->search), "");
	g_object_set(palette->search, "placeholder-text", prompt, NULL);
	spoken_name(palette->search, prompt);
	fill(palette);
}

GtkWidget *ladder_palette_new(LadderDocument *document)
{
	LadderPalette *palette = g_object_new(LADDER_TYPE_PALETTE, NULL);

	palette->document = g_object_ref(document);
	palette->kind = PALETTE_LADDER;
	g_signal_connect(palette, "map", G_CALLBACK(shown), NULL);
	g_signal_connect_object(document, "project-changed", G_CALLBACK(project_changed),
				palette, G_CONNECT_SWAPPED);
	fill(palette);
	return GTK_WIDGET(palette);
}
