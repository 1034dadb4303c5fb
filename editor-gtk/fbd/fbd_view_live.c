/* SPDX-License-Identifier: MIT
 *
 * fbd_view_live - values of the running program on the pins and wires of networks.
 *
 * It shows what the scan has computed and evaluates nothing: the value of a name in place, of an output of an
 * instance, of a wire that has a name. The result of another box is what the line of the list left that computes it;
 * a board keeps no such results, so there a simulation of the sheet computes them of the values that it sends
 * (sim/sim_shadow.h).
 */
#include "editor-gtk/fbd/fbd_view_inside.h"

#include "editor-gtk/sim/sim_shadow.h"
#include "editor-gtk/sim/st_why.h"

#include <string.h>

/* Where the values of a network are, looked up once a program. */
struct fbd_places {
	LadderFbdView *view;
	int network;
	struct location *pin;      /* by pin                                    */
	uint32_t *ran;             /* by pin: a BOOL, has what computes it run? 0: it needs not */
	bool *computed;            /* by pin: both are places of view->results  */
	struct location *now, *goal; /* by box: what it counts, and up to where   */
	struct location at[];
};

static struct location find(LadderFbdView *view, const char *name)
{
	return live_map_find(view->map, name, strlen(name));
}

/* A wire is a variable of the POU, with the number of its network. */
static struct location find_wire(LadderFbdView *view, int network, const char *name, bool before)
{
	char *text = g_strdup_printf("%s.%c%d", name, before ? 'P' : 'N', network + 1);
	const struct location at = find(view, text);

	g_free(text);
	return at;
}

static bool is_wire(const struct fbd_graph *graph, const char *name)
{
	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].name && strcmp(graph->wire[i].name, name) == 0)
			return true;
	return false;
}

/* ---- results of a board ---- */

void fbd_live_end(LadderFbdView *view, bool all)
{
	fbd_forget_places(view);
	if (!all || !view->results)
		return;
	g_clear_pointer(&view->results_map, live_map_free);
	g_signal_handlers_disconnect_by_data(view->results, view);
	ladder_sim_end(view->results);
	g_clear_object(&view->results);
}

/* Power became known, or is not known any more. */
static void results_changed(LadderFbdView *view)
{
	fbd_forget_places(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void unmapped(LadderFbdView *view)
{
	fbd_live_end(view, true);
}

void fbd_live_watch(LadderFbdView *view)
{
	g_signal_connect(view, "map", G_CALLBACK(results_changed), NULL);
	g_signal_connect_after(view, "unmap", G_CALLBACK(unmapped), NULL); /* then it is not mapped */
}

/* NULL: the program that runs keeps them itself, or is another one, or nobody sees them. */
static LadderSim *results_of(LadderFbdView *view)
{
	LadderSim *sim = view->canvas->sim;
	LadderDocument *document = view->canvas->document;

	if (!ladder_sim_board(sim) || document != ladder_sim_document(sim) || ladder_sim_older(sim, NULL) ||
	    !gtk_widget_get_mapped(GTK_WIDGET(view)) || !ladder_sim_runs_all_of(sim, document, view->canvas->pou))
		return NULL;
	if (view->results && view->results_version == ladder_document_version(document))
		return ladder_sim_is_on(view->results) ? view->results : NULL;
	fbd_live_end(view, true);
	view->results = ladder_sim_new(document);
	view->results_version = ladder_document_version(document);
	if (!ladder_sim_follow(view->results, sim, view->canvas->pou))
		return NULL;
	g_signal_connect_swapped(view->results, "program-changed", G_CALLBACK(results_changed), view);
	return view->results;
}

static struct live_map *results_map(LadderFbdView *view, LadderSim *results)
{
	if (!view->results_map) {
		view->results_map = live_map_new(&ladder_sim_twin(results)->resource,
			project_text(ladder_document_project(view->canvas->document), fbd_pou(view)->name), NULL);
		live_map_set_sim(view->results_map, results);
	}
	return view->results_map;
}

/* The result of a box, which no variable need have. */
static struct live_result find_made(LadderFbdView *view, const struct fbd_box *box, bool *computed)
{
	LadderSim *results = results_of(view), *sim = results ? results : view->canvas->sim;
	struct ladder *ladder = ladder_sim_ladder(sim);
	const struct project *running = ladder ? ladder_project(ladder) : NULL;
	const int pou = ladder_sim_pou(sim, view->canvas->document, view->canvas->pou);
	const struct il *il = running && pou >= 0 ? ladder_il(ladder, pou) : NULL;
	struct live_result result = { .at.type = IEC_NONE };
	int first, last;

	/* Another statement may stand there since an edit. */
	if (il && box->made && fbd_lines_place(running, &running->pou[pou], box->item, &first, &last) &&
	    strcmp(fbd_lines_text(running, &running->pou[pou], box->item),
		   fbd_lines_text(ladder_document_project(view->canvas->document), fbd_pou(view), box->item)) == 0 &&
	    !live_map_made(results ? results_map(view, results) : view->map, il, first, last, box->made, &result))
		result.at.type = IEC_NONE;
	*computed = results != NULL;
	return result;
}

/* The output that has the result of its box: OUT of a function, the one of an operator. */
static bool is_result(const struct fbd_graph *graph, int pin)
{
	const struct fbd_pin *p = &graph->pin[pin];

	return graph->box[p->box].made && (!*p->name || strcmp(p->name, "OUT") == 0);
}

static struct location find_output(LadderFbdView *view, int network, const struct fbd_graph *graph, int pin,
				   uint32_t *ran, bool *computed)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const struct fbd_box *box = &graph->box[p->box];
	const struct live_result made = is_result(graph, pin) ? find_made(view, box, computed) :
					(struct live_result){ .at.type = IEC_NONE };

	*computed = *computed && made.at.type != IEC_NONE;
	if (made.at.type != IEC_NONE) {
		*ran = made.ran;
		return made.at;
	}
	if (box->kind == FBD_BLOCK && box->instance && p->name[0] && !p->negated)
		return live_map_find_pin(view->map, box->instance, p->name);
	if (p->operand)
		return find(view, p->operand);
	for (int i = 0; i < graph->wire_count; i++)
		if (graph->wire[i].from_pin == pin && graph->wire[i].name)
			return find_wire(view, network, graph->wire[i].name, false);
	for (int i = 0; i < graph->box_count; i++) { /* what is stored from it */
		const struct fbd_box *store = &graph->box[i];

		if (store->kind == FBD_STORE && store->pins > 0 && !graph->pin[store->first_pin].negated &&
		    fbd_graph_source(graph, store->first_pin) == pin && store->target)
			return find(view, store->target);
	}
	for (int i = 0; i < graph->pin_count; i++) { /* what an instance was given from it */
		const struct fbd_box *reader = &graph->box[graph->pin[i].box];

		if (!graph->pin[i].output && reader->kind == FBD_BLOCK && reader->instance &&
		    !graph->pin[i].negated && !graph->pin[i].previous && fbd_graph_source(graph, i) == pin)
			return live_map_find_pin(view->map, reader->instance, graph->pin[i].name);
	}
	return (struct location){ .type = IEC_NONE };
}

static struct location find_pin(LadderFbdView *view, int network, const struct fbd_graph *graph, int pin,
				uint32_t *ran, bool *computed)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const int source = p->output ? pin : fbd_graph_source(graph, pin);

	if (p->operand && p->previous && is_wire(graph, p->operand))
		return find_wire(view, network, p->operand, true);
	if (!p->output && p->operand)
		return find(view, p->operand);
	return source >= 0 ? find_output(view, network, graph, source, ran, computed) : (struct location){ .type = IEC_NONE };
}

static void find_count(LadderFbdView *view, const struct fbd_box *box, struct location *now, struct location *goal)
{
	const char *counts, *up_to;

	if (box->kind != FBD_BLOCK || !box->row || !box->instance ||
	    !live_word_counts(box->row, &counts, &up_to))
		return;
	*now = live_map_find_pin(view->map, box->instance, counts);
	*goal = live_map_find_pin(view->map, box->instance, up_to);
}

static void make_map(LadderFbdView *view)
{
	if (view->map)
		return;
	view->map = live_map_new(&ladder_sim_twin(view->canvas->sim)->resource,
		project_text(ladder_document_project(view->canvas->document), fbd_pou(view)->name), NULL);
	live_map_set_sim(view->map, view->canvas->sim);
}

static struct fbd_places *find_places(LadderFbdView *view, int network)
{
	const struct fbd_graph *graph = fbd_graph_of(view, network);
	const size_t pins = (size_t)graph->pin_count, boxes = (size_t)graph->box_count;
	struct fbd_places *places = g_malloc0(sizeof(*places) +
		(pins + 2 * boxes + 1) * sizeof(struct location) + pins * (sizeof(uint32_t) + sizeof(bool)));

	*places = (struct fbd_places){ .view = view, .network = network };
	places->pin = places->at;
	places->now = places->at + pins;
	places->goal = places->now + boxes;
	places->ran = (uint32_t *)(places->goal + boxes + 1);
	places->computed = (bool *)(places->ran + pins);
	for (int i = 0; i < graph->pin_count; i++)
		places->pin[i] = find_pin(view, network, graph, i, &places->ran[i], &places->computed[i]);
	for (int i = 0; i < graph->box_count; i++)
		find_count(view, &graph->box[i], &places->now[i], &places->goal[i]);
	return places;
}

static const struct image *image_of(const struct fbd_places *places, int pin)
{
	LadderFbdView *view = places->view;

	return &ladder_sim_twin(places->computed[pin] ? view->results : view->canvas->sim)->resource.image;
}

static unsigned int pin_state(void *context, int pin, char *text, size_t size)
{
	const struct fbd_places *places = context;
	const struct image *image = image_of(places, pin);
	const struct location at = places->pin[pin];

	text[0] = '\0';
	if (at.type == IEC_NONE ||
	    (places->ran[pin] && !image_get(image, (struct location){ .type = IEC_BOOL, .where = places->ran[pin] }).i))
		return 0;
	if (at.type == IEC_BOOL)
		return LIVE_KNOWN | (image_get(image, at).i ? LIVE_OUT : 0);
	live_value_print(at.type, image_get(image, at), text, size);
	return LIVE_KNOWN;
}

static unsigned int box_state(void *context, int box, float *part)
{
	const struct fbd_places *places = context;
	const struct fbd_graph *graph = fbd_graph_of(places->view, places->network);
	const struct image *image = &ladder_sim_twin(places->view->canvas->sim)->resource.image;
	const struct fbd_box *of = &graph->box[box];
	const struct location enable = of->pins > 0 && strcmp(graph->pin[of->first_pin].name, "EN") == 0 ?
				       places->pin[of->first_pin] : (struct location){ .type = IEC_NONE };
	double goal;

	*part = -1;
	if (places->now[box].type != IEC_NONE && places->goal[box].type != IEC_NONE) {
		goal = live_value_number(places->goal[box].type, image_get(image, places->goal[box]));
		if (goal > 0)
			*part = (float)CLAMP(live_value_number(places->now[box].type,
				image_get(image, places->now[box])) / goal, 0, 1);
	}
	return LIVE_KNOWN |
	       (enable.type == IEC_BOOL && !image_get(image_of(places, of->first_pin), enable).i ? 0 : LIVE_OUT);
}

bool fbd_live_look(LadderFbdView *view, int network, struct fbd_live *out)
{
	if (!canvas_is_live(LADDER_CANVAS(view)) || !ladder_sim_twin(view->canvas->sim) || !fbd_pou(view))
		return false;
	results_of(view); /* before places are looked up: it forgets them */
	make_map(view);
	if (!view->map)
		return false;
	if (!view->strip[network].places)
		view->strip[network].places = find_places(view, network);
	*out = (struct fbd_live){ pin_state, box_state, view->strip[network].places };
	return true;
}

static void mark_value(LadderFbdView *view, struct location at, int box, int pin, GArray *marks)
{
	LadderSim *sim = view->canvas->sim;
	const enum sim_quality quality = at.type == IEC_NONE ? SIM_GOOD : ladder_sim_quality(sim, at);
	const struct fbd_mark mark = { box, pin, (at.type != IEC_NONE && live_value_is_forced(sim, false, at) ? MARK_FORCED : 0u) |
		(quality == SIM_STALE ? MARK_STALE : quality == SIM_VALUE_FAULT ? MARK_FAULT : 0u) };

	if (mark.marks)
		g_array_append_val(marks, mark);
}

void fbd_live_marks(LadderFbdView *view, int network, GArray *marks)
{
	const struct fbd_graph *graph = fbd_graph_of(view, network);
	struct fbd_live live;

	if (!fbd_live_look(view, network, &live))
		return;
	for (int i = 0; i < graph->pin_count; i++)
		if (!graph->pin[i].output && graph->pin[i].operand && !graph->pin[i].previous)
			mark_value(view, view->strip[network].places->pin[i], graph->pin[i].box, i, marks);
	for (int i = 0; i < graph->box_count; i++)
		if (graph->box[i].kind == FBD_STORE && graph->box[i].target)
			mark_value(view, find(view, graph->box[i].target), i, -1, marks);
}

/* Where the value at a place is; type IEC_NONE: not known. */
static struct location place_of_value(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_box *box = fbd_box_at(view, at);
	struct fbd_live live;
	const struct location none = { .type = IEC_NONE };

	if (!box || !fbd_live_look(view, at.network, &live))
		return none;
	if (at.pin >= 0) /* a board has no place for what is computed here */
		return view->strip[at.network].places->computed[at.pin] ? none :
		       view->strip[at.network].places->pin[at.pin];
	return box->target && box->kind != FBD_JUMP ? find(view, box->target) : none;
}

/* The name of the variable that a pin reads or has; NULL: it has none. Caller frees. */
static char *variable_of(const struct fbd_graph *graph, int pin)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const int source = p->output ? pin : fbd_graph_source(graph, pin);
	const struct fbd_box *box;

	if (!p->output && p->operand)
		return is_wire(graph, p->operand) ? NULL : g_strdup(p->operand);
	if (source < 0)
		return NULL;
	p = &graph->pin[source];
	box = &graph->box[p->box];
	if (p->operand)
		return g_strdup(p->operand);
	return box->kind == FBD_BLOCK && box->instance && p->name[0] ?
	       g_strdup_printf("%s.%s", box->instance, p->name) : NULL;
}

struct location fbd_live_variable(LadderFbdView *view, struct fbd_pos at, char **name)
{
	const struct fbd_box *box = fbd_box_at(view, at);
	struct location place = { .type = IEC_NONE };
	struct fbd_live live;
	char *variable = NULL;

	if (box && fbd_live_look(view, at.network, &live))
		variable = at.pin >= 0 ? variable_of(fbd_graph_of(view, at.network), at.pin) :
			   box->target && box->kind != FBD_JUMP ? g_strdup(box->target) : NULL;
	if (variable)
		place = find(view, variable);
	if (name)
		*name = g_steal_pointer(&variable);
	g_free(variable);
	return place;
}

char *fbd_live_text(LadderFbdView *view, struct fbd_pos at)
{
	struct location place = place_of_value(view, at);
	const struct fbd_places *places = at.network >= 0 && at.network < view->count ? view->strip[at.network].places : NULL;
	LadderSim *sim = view->canvas->sim;
	const struct image *image;
	char text[IEC_VALUE_TEXT];
	const char *quality;
	bool computed = false;

	if (!canvas_is_live(LADDER_CANVAS(view)) || !ladder_sim_twin(sim))
		return NULL;
	image = &ladder_sim_twin(sim)->resource.image;
	if (places && at.pin >= 0 && places->computed[at.pin]) {
		computed = true;
		place = places->pin[at.pin];
		image = image_of(places, at.pin);
	}
	if (place.type == IEC_NONE)
		return NULL;
	live_value_print(place.type, image_get(image, place), text, sizeof(text));
	quality = computed ? "" : live_quality_word(ladder_sim_quality(sim, place));
	return g_strdup_printf("%s%s%s", text, *quality ? ", " : "", quality);
}

/* ---- why ---- */

/* The input that a place asks about: that of the cursor, else the first one of its box; -1: none. */
static int asked_pin(const struct fbd_graph *graph, struct fbd_pos at)
{
	const struct fbd_box *box = &graph->box[at.box];

	if (at.pin >= 0 && !graph->pin[at.pin].output)
		return at.pin;
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		if (!graph->pin[i].output && graph->pin[i].len)
			return i;
	return -1;
}

/* The first BOOL input of an instance; -1: it has none with a value. */
static int first_bool(const struct fbd_graph *graph, const struct fbd_box *box)
{
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		if (!graph->pin[i].output && graph->pin[i].len && graph->pin[i].declared &&
		    graph->pin[i].declared->type == IEC_BOOL)
			return i;
	return -1;
}

static char *item_text(LadderFbdView *view, int item, int at, int len)
{
	const struct project *project = ladder_document_project(view->canvas->document);

	return g_strndup(fbd_lines_text(project, fbd_pou(view), item) + at, (gsize)len);
}

/* Why a pin has its value. A wire is followed to the operator or function that makes it. */
static char *why_pin(LadderFbdView *view, int network, const struct fbd_graph *graph, int pin)
{
	const struct fbd_pin *p = &graph->pin[pin];
	const int source = fbd_graph_source(graph, pin);
	const struct fbd_box *from = source >= 0 ? &graph->box[graph->pin[source].box] : NULL;
	const bool made = from && (from->kind == FBD_OPERATOR || from->kind == FBD_FUNCTION) && from->len;
	char *text = made ? item_text(view, from->item, from->at, from->len) :
			    item_text(view, graph->box[p->box].item, p->at, p->len);
	char *why = st_why_network(view->canvas->sim, project_text(ladder_document_project(view->canvas->document),
							       fbd_pou(view)->name), network, text);

	g_free(text);
	return why;
}

char *ladder_fbd_view_why(LadderFbdView *view)
{
	const struct fbd_pos at = view->cursor;
	const struct fbd_graph *graph;
	const struct fbd_box *from;
	int pin, source, inner;
	char *why, *deeper, *both;

	if (!fbd_box_at(view, at) || !fbd_pou(view) || !canvas_is_live(LADDER_CANVAS(view)))
		return NULL;
	graph = fbd_graph_of(view, at.network);
	pin = asked_pin(graph, at);
	why = pin >= 0 ? why_pin(view, at.network, graph, pin) : NULL;
	source = why ? fbd_graph_source(graph, pin) : -1;
	from = source >= 0 ? &graph->box[graph->pin[source].box] : NULL;
	inner = from && from->kind == FBD_BLOCK && from->instance ? first_bool(graph, from) : -1;
	deeper = inner >= 0 ? why_pin(view, at.network, graph, inner) : NULL;
	if (!deeper)
		return why;
	both = g_strdup_printf("%s · %s.%s %s", why, from->instance, graph->pin[inner].name, deeper);
	g_free(why);
	g_free(deeper);
	return both;
}
