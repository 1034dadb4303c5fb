/* SPDX-License-Identifier: MIT
 *
 * fbd_plan - columns, order, rows and ways of a network; see fbd_plan.h.
 *
 * The steps are those of Sugiyama's method: columns by the longest path, the order in a column by
 * barycentres, rows by medians that keep the order. A wire that passes a column has a node there, as a box has, so
 * that it has a row of its own. A channel is routed by itself: a wire from the left at a row where
 * another one leaves to the right has its vertical part left of that of the other one.
 */
#include "engine/show/fbd_plan.h"

#include <stdlib.h>
#include <string.h>

#define SWEEPS      6
#define COUNTED   400 /* edges of a gap whose crossings are counted            */
#define WAY_WEIGHT  8 /* of a wire that passes a column: it stays straight      */
#define HINT_WEIGHT 100000
#define LOOSE   1000000 /* rows above everything                               */

/* A box, or a wire that passes a column. */
struct node {
	int box, net;        /* one of them; the other -1                        */
	int layer;
	int row;             /* of its first pin                                 */
	int rows, up, down;  /* rows from the first to the last pin; around them */
	bool loose;          /* it has no edges                                  */
	int place;           /* in its column                                    */
	double wish;
};

/* Part of a wire between two columns, by its ends. */
struct bond {
	int left, right;     /* nodes                                            */
	int left_port, right_port; /* rows below the first pin                   */
	int net;
};

/* All wires from one output. */
struct net {
	int pin;
	int box, last;       /* the box of the pin; the last column that it leads to */
	int first_way;       /* node in the column behind that of the box; -1: none */
	int lane;            /* row of its feedback; -1: it has none              */
	float lane_from, lane_to; /* x                                          */
};

struct layer { int *node; int count; float x, lead, width; };
struct gap { struct bond *edge; int count; };

struct planner {
	const struct fbd_graph *graph;
	const struct fbd_metrics *metrics;
	struct fbd_plan *plan;
	struct arena arena;
	struct node *node;
	int nodes;
	struct net *net;
	int nets;
	int *net_of;         /* by pin                                           */
	struct layer *layer;
	int layers;
	struct gap *gap;     /* gap g is before layer g                          */
	bool hinted;         /* a box has a row                                  */
	int lanes;           /* the row of the first lane                        */
};

bool fbd_is_end(const struct fbd_box *box)
{
	return box->kind == FBD_STORE || box->kind == FBD_SET || box->kind == FBD_RESET ||
	       box->kind == FBD_JUMP || box->kind == FBD_RETURN || box->kind == FBD_STOP;
}

/* Rows of pin @pin below the first pin of its box. */
static int port_of(const struct fbd_graph *graph, int pin)
{
	return fbd_pin_number(graph, pin) - 1;
}

static int most(int a, int b)
{
	return a > b ? a : b;
}

static float widest(float a, float b)
{
	return a > b ? a : b;
}

/* ---- columns ---- */

/* The source box of an input of this scan; -1: none. */
static int source_box(const struct fbd_graph *graph, int pin)
{
	const int source = graph->pin[pin].previous ? -1 : fbd_graph_source(graph, pin);

	return source < 0 ? -1 : graph->pin[source].box;
}

static bool is_fed(const struct fbd_graph *graph, int box)
{
	const struct fbd_box *b = &graph->box[box];

	for (int i = b->first_pin; i < b->first_pin + b->pins; i++)
		if (source_box(graph, i) >= 0)
			return true;
	return false;
}

/* Boxes that read nothing stand just before the first one that reads them. */
static void pull_right(struct planner *p, int *layer)
{
	const struct fbd_graph *graph = p->graph;
	int *least = arena_alloc(&p->arena, (size_t)(graph->box_count + 1) * sizeof(*least));

	for (int i = graph->box_count - 1; i >= 0 && least; i--) {
		const struct fbd_box *box = &graph->box[i];

		if (least[i] && !is_fed(graph, i) && !box->at_column)
			layer[i] = least[i] - 1;
		for (int k = box->first_pin; k < box->first_pin + box->pins && !fbd_is_end(box); k++) {
			const int from = source_box(graph, k);

			if (from >= 0 && (!least[from] || least[from] > layer[i]))
				least[from] = layer[i];
		}
	}
}

/* The column of each box, from 0. Boxes are in an order in which each reads those before it. */
static int *find_layers(struct planner *p)
{
	const struct fbd_graph *graph = p->graph;
	int *layer = arena_alloc(&p->arena, (size_t)(graph->box_count + 1) * sizeof(*layer));
	int last = 0, boxes = 0;

	if (!layer)
		return NULL;
	for (int i = 0; i < graph->box_count; i++) {
		const struct fbd_box *box = &graph->box[i];

		layer[i] = box->at_column > 0 && box->at_column <= LIMIT_COLS ? box->at_column - 1 : 0;
		for (int k = box->first_pin; k < box->first_pin + box->pins; k++) {
			const int from = source_box(graph, k);

			if (from >= 0 && from < i)
				layer[i] = most(layer[i], layer[from] + 1);
		}
		boxes += !fbd_is_end(box);
		last = most(last, layer[i] + !fbd_is_end(box));
	}
	pull_right(p, layer);
	for (int i = 0; i < graph->box_count; i++)
		if (fbd_is_end(&graph->box[i]))
			layer[i] = boxes ? last : layer[i];
	p->layers = graph->box_count ? last + 1 : 0;
	return layer;
}

/* ---- nodes and edges ---- */

static int add_node(struct planner *p, struct node node)
{
	struct node *new = arena_push(&p->arena, &p->node, &p->nodes, sizeof(*new));

	if (!new)
		return -1;
	*new = node;
	return p->nodes - 1;
}

static void add_box(struct planner *p, int box, int layer)
{
	const struct fbd_box *b = &p->graph->box[box];
	const struct fbd_metrics *m = p->metrics;
	struct node node = { .box = box, .net = -1, .layer = layer };
	int inputs = 0;

	for (int i = b->first_pin; i < b->first_pin + b->pins; i++)
		inputs += !p->graph->pin[i].output;
	node.rows = most(most(inputs, b->pins - inputs) - 1, 0);
	if (fbd_is_end(b)) {
		node.up = m->end_head;
		node.down = m->end_foot;
	} else if (b->kind != FBD_VALUE) {
		node.up = m->head + (b->instance ? m->instance : 0);
		node.down = m->foot;
	}
	p->hinted |= b->at_row > 0;
	add_node(p, node);
}

static void add_edge(struct planner *p, int gap, struct bond edge)
{
	struct bond *new = arena_push(&p->arena, &p->gap[gap].edge, &p->gap[gap].count, sizeof(*new));

	if (new)
		*new = edge;
}

static bool is_forward(const struct planner *p, int from, int pin)
{
	return p->node[p->graph->pin[pin].box].layer > p->node[from].layer;
}

/* The nets: how far each reaches. */
static void find_nets(struct planner *p)
{
	const struct fbd_graph *graph = p->graph;

	for (int pin = 0; pin < graph->pin_count; pin++) {
		const int from = fbd_graph_source(graph, pin);
		struct net *net;

		if (from < 0)
			continue;
		if (!p->net_of[from]) {
			net = arena_push(&p->arena, &p->net, &p->nets, sizeof(*net));
			if (!net)
				return;
			*net = (struct net){ .pin = from, .box = graph->pin[from].box, .first_way = -1,
					     .lane = -1 };
			net->last = p->node[net->box].layer;
			p->net_of[from] = p->nets;
		}
		net = &p->net[p->net_of[from] - 1];
		if (is_forward(p, net->box, pin))
			net->last = most(net->last, p->node[graph->pin[pin].box].layer);
		else
			net->lane = 0;
	}
}

/* The node of a net on the left of column @layer. */
static int left_node(const struct net *net, const struct node *node, int layer)
{
	return layer == node[net->box].layer + 1 ? net->box : net->first_way + layer - node[net->box].layer - 2;
}

static void add_edges(struct planner *p)
{
	const struct fbd_graph *graph = p->graph;

	for (int n = 0; n < p->nets; n++) {
		struct net *net = &p->net[n];
		const int from = p->node[net->box].layer;

		for (int l = from + 1; l < net->last; l++) {
			const int way = add_node(p, (struct node){ .box = -1, .net = n, .layer = l });

			if (l == from + 1)
				net->first_way = way;
		}
		for (int l = from + 1; l < net->last; l++) {
			const int left = left_node(net, p->node, l);

			add_edge(p, l, (struct bond){ left, net->first_way + l - from - 1,
				 left == net->box ? port_of(graph, net->pin) : 0, 0, n });
		}
	}
	for (int pin = 0; pin < graph->pin_count; pin++) {
		const int from = fbd_graph_source(graph, pin), box = graph->pin[pin].box;
		const struct net *net = from < 0 ? NULL : &p->net[p->net_of[from] - 1];
		int left;

		if (!net || !is_forward(p, net->box, pin))
			continue;
		left = left_node(net, p->node, p->node[box].layer);
		add_edge(p, p->node[box].layer, (struct bond){ left, box,
			 left == net->box ? port_of(graph, net->pin) : 0, port_of(graph, pin),
			 p->net_of[from] - 1 });
	}
}

static bool make_nodes(struct planner *p)
{
	const int *layer = find_layers(p);

	if (!layer)
		return false;
	p->gap = arena_alloc(&p->arena, (size_t)(p->layers + 1) * sizeof(*p->gap));
	p->layer = arena_alloc(&p->arena, (size_t)(p->layers + 1) * sizeof(*p->layer));
	p->net_of = arena_alloc(&p->arena, (size_t)(p->graph->pin_count + 1) * sizeof(*p->net_of));
	if (!p->gap || !p->layer || !p->net_of)
		return false;
	for (int i = 0; i < p->graph->box_count; i++)
		add_box(p, i, layer[i]);
	if (p->arena.failed)
		return false;
	find_nets(p);
	if (!p->arena.failed)
		add_edges(p);
	for (int i = 0; i < p->nodes && !p->arena.failed; i++) {
		struct layer *l = &p->layer[p->node[i].layer];
		int *place = arena_push(&p->arena, &l->node, &l->count, sizeof(*place));

		if (place)
			*place = i;
	}
	return !p->arena.failed;
}

/* ---- the order in a column ---- */

/* Sorts the nodes of a column by their wishes; equal ones stay in their order. */
static void sort_layer(struct planner *p, struct layer *layer)
{
	for (int i = 1; i < layer->count; i++) {
		const int node = layer->node[i];
		int k = i;

		for (; k > 0 && p->node[layer->node[k - 1]].wish > p->node[node].wish; k--)
			layer->node[k] = layer->node[k - 1];
		layer->node[k] = node;
	}
}

/* Puts the nodes of a column below each other, each at its wish or below it. */
static void stack_layer(struct planner *p, const struct layer *layer)
{
	int next = 0;

	for (int i = 0; i < layer->count; i++) {
		struct node *node = &p->node[layer->node[i]];
		const int wish = (int)node->wish;

		node->row = most(next + node->up, i ? wish : most(wish, node->up));
		next = node->row + node->rows + node->down + 1;
	}
}

/* Sorts a column by the columns on one side of it. */
static void sweep(struct planner *p, int l, bool by_left)
{
	struct layer *layer = &p->layer[l];
	const struct gap *gap = &p->gap[by_left ? l : l + 1];
	int *count = arena_alloc(&p->arena, (size_t)(p->nodes + 1) * sizeof(*count));

	if (!count)
		return;
	for (int i = 0; i < layer->count; i++)
		p->node[layer->node[i]].wish = 0;
	for (int i = 0; i < gap->count; i++) {
		const struct bond *e = &gap->edge[i];
		const int own = by_left ? e->right : e->left, other = by_left ? e->left : e->right;
		const int port = by_left ? e->left_port - e->right_port : e->right_port - e->left_port;

		p->node[own].wish += p->node[other].row + port;
		count[own]++;
	}
	for (int i = 0; i < layer->count; i++) {
		struct node *node = &p->node[layer->node[i]];

		node->wish = count[layer->node[i]] ? node->wish / count[layer->node[i]] : node->row;
	}
	sort_layer(p, layer);
	stack_layer(p, layer);
}

static long crossings(const struct planner *p)
{
	long sum = 0;

	for (int g = 1; g < p->layers; g++) {
		const struct gap *gap = &p->gap[g];

		for (int i = 0; i < gap->count && gap->count <= COUNTED; i++)
			for (int k = 0; k < i; k++) {
				const struct bond *a = &gap->edge[i], *b = &gap->edge[k];
				const int left = p->node[a->left].row + a->left_port -
						 p->node[b->left].row - b->left_port;
				const int right = p->node[a->right].row + a->right_port -
						  p->node[b->right].row - b->right_port;

				sum += a->net != b->net && ((left < 0 && right > 0) || (left > 0 && right < 0));
			}
	}
	return sum;
}

/* Keeps the order of all columns in @best, or takes it from there. */
static void copy_order(struct planner *p, int *best, bool keep)
{
	for (int l = 0, at = 0; l < p->layers; at += p->layer[l++].count) {
		const size_t size = (size_t)p->layer[l].count * sizeof(*best);

		if (keep && size)
			memcpy(best + at, p->layer[l].node, size);
		else if (size)
			memcpy(p->layer[l].node, best + at, size);
	}
}

static void find_order(struct planner *p)
{
	int *best = arena_alloc(&p->arena, (size_t)(p->nodes + 1) * sizeof(*best));
	long least;

	if (!best)
		return;
	for (int l = 0; l < p->layers; l++)
		stack_layer(p, &p->layer[l]);
	for (int l = 1; l < p->layers; l++)
		sweep(p, l, true);
	least = crossings(p);
	copy_order(p, best, true);
	for (int i = 0; i < SWEEPS && least; i++) {
		long now;

		for (int l = p->layers - 2; l >= 0; l--)
			sweep(p, l, false);
		for (int l = 1; l < p->layers; l++)
			sweep(p, l, true);
		now = crossings(p);
		if (now >= least)
			continue;
		least = now;
		copy_order(p, best, true);
	}
	copy_order(p, best, false);
}

/* ---- rows ---- */

/* Nodes that touch each other, moved as one: their wish less their distance from the first one. */
struct wish { int value, weight; };
struct block { int first, count, value; };

static int by_value(const void *a, const void *b)
{
	const struct wish *x = a, *y = b;

	return (x->value > y->value) - (x->value < y->value);
}

/* The weighted median of the block's wishes. @room: for as many. */
static int median(const struct wish *wish, const struct block *block, struct wish *room)
{
	long all = 0, sum = 0;
	int i = 0;

	memcpy(room, wish + block->first, (size_t)block->count * sizeof(*room));
	qsort(room, (size_t)block->count, sizeof(*room), by_value);
	for (int k = 0; k < block->count; k++)
		all += room[k].weight;
	for (; i < block->count - 1; i++) {
		sum += room[i].weight;
		if (2 * sum >= all)
			break;
	}
	return room[i].value;
}

/* What a node would be straight with: the median over its edges on the sides that count. */
static bool find_wish(struct planner *p, int node, bool left, bool right, const int *first_edge,
		      const int *edge_next, int *out)
{
	int value[32], count = 0;

	for (int side = 0; side < 2; side++) {
		const struct gap *gap = &p->gap[p->node[node].layer + side];

		if (!(side ? right : left))
			continue;
		for (int i = first_edge[2 * node + side]; i >= 0 && count < 32; i = edge_next[2 * i + side]) {
			const struct bond *e = &gap->edge[i - first_edge[2 * p->nodes + p->node[node].layer + side]];

			value[count++] = side ? p->node[e->right].row + e->right_port - e->left_port :
					 p->node[e->left].row + e->left_port - e->right_port;
		}
	}
	for (int i = 1; i < count; i++)
		for (int k = i; k > 0 && value[k - 1] > value[k]; k--) {
			const int swap = value[k];

			value[k] = value[k - 1];
			value[k - 1] = swap;
		}
	*out = count ? value[(count - 1) / 2] : p->node[node].row;
	p->node[node].loose = first_edge[2 * node] < 0 && first_edge[2 * node + 1] < 0;
	return count > 0;
}

struct index { int *first, *next; };

/* Lists of the edges at each node: first[2 * node + side], next[2 * edge + side]; edges are numbered over all gaps,
 * and first[2 * nodes + gap] is the number of the gap's first edge. */
static bool index_edges(struct planner *p, struct index *out)
{
	int edges = 0;

	for (int g = 0; g <= p->layers; g++)
		edges += p->gap[g].count;
	out->first = arena_alloc(&p->arena, (size_t)(2 * p->nodes + p->layers + 2) * sizeof(int));
	out->next = arena_alloc(&p->arena, (size_t)(2 * edges + 2) * sizeof(int));
	if (!out->first || !out->next)
		return false;
	for (int i = 0; i < 2 * p->nodes; i++)
		out->first[i] = -1;
	edges = 0;
	for (int g = 0; g <= p->layers; g++) {
		out->first[2 * p->nodes + g] = edges;
		for (int i = 0; i < p->gap[g].count; i++, edges++) {
			const struct bond *e = &p->gap[g].edge[i];

			out->next[2 * edges] = out->first[2 * e->right];
			out->first[2 * e->right] = edges;
			out->next[2 * edges + 1] = out->first[2 * e->left + 1];
			out->first[2 * e->left + 1] = edges;
		}
	}
	return true;
}

struct room { struct wish *wish, *sorted; struct block *block; struct index index; };

/* The rows of a column: as near to the wishes as the order allows. */
static void place_layer(struct planner *p, const struct layer *layer, bool left, bool right, struct room *room)
{
	int apart = 0, blocks = 0;

	for (int i = 0; i < layer->count; i++) {
		const struct node *node = &p->node[layer->node[i]];
		const int hint = node->box < 0 ? 0 : p->graph->box[node->box].at_row;
		int wish;
		const bool tied = find_wish(p, layer->node[i], left, right, room->index.first, room->index.next, &wish);

		apart += i ? p->node[layer->node[i - 1]].rows + p->node[layer->node[i - 1]].down + node->up + 1 : 0;
		room->wish[i] = (struct wish){ wish - apart, !tied ? 1 : node->box < 0 ? WAY_WEIGHT : 4 };
		if (node->loose) /* just below the one before it */
			room->wish[i] = (struct wish){ -LOOSE, 0 };
		if (hint)
			room->wish[i] = (struct wish){ hint - 1 + node->up - apart, HINT_WEIGHT };
		room->block[blocks++] = (struct block){ i, 1, room->wish[i].value };
		while (blocks > 1 && room->block[blocks - 2].value > room->block[blocks - 1].value) {
			blocks--;
			room->block[blocks - 1].count += room->block[blocks].count;
			room->block[blocks - 1].value = median(room->wish, &room->block[blocks - 1], room->sorted);
		}
	}
	apart = 0;
	for (int b = 0; b < blocks && p->hinted; b++)
		if (room->block[b].value > -LOOSE / 2)
			room->block[b].value = most(room->block[b].value, p->node[layer->node[0]].up);
	for (int b = 0; b < blocks; b++)
		for (int i = room->block[b].first; i < room->block[b].first + room->block[b].count; i++) {
			struct node *node = &p->node[layer->node[i]];

			apart += i ? p->node[layer->node[i - 1]].rows + p->node[layer->node[i - 1]].down + node->up + 1 : 0;
			node->row = room->block[b].value + apart;
		}
}

static long straight(const struct planner *p)
{
	long sum = 0;

	for (int g = 1; g < p->layers; g++)
		for (int i = 0; i < p->gap[g].count; i++) {
			const struct bond *e = &p->gap[g].edge[i];
			const int bend = p->node[e->left].row + e->left_port - p->node[e->right].row - e->right_port;

			sum += bend ? -(bend < 0 ? -bend : bend) : 20;
		}
	return sum;
}

/* Boxes with a hint are put into the order of their column where their row is. */
static void sort_hints(struct planner *p)
{
	for (int l = 0; l < p->layers; l++) {
		for (int i = 0; i < p->layer[l].count; i++) {
			struct node *node = &p->node[p->layer[l].node[i]];
			const int hint = node->box < 0 ? 0 : p->graph->box[node->box].at_row;

			node->wish = hint ? hint - 1 + node->up : node->row;
		}
		sort_layer(p, &p->layer[l]);
	}
}

/* The rows that a node can have while all others keep theirs. */
static void free_rows(const struct planner *p, int node, int *low, int *high)
{
	const struct node *n = &p->node[node];
	const struct layer *layer = &p->layer[n->layer];

	*low = -LOOSE / 2;
	*high = LOOSE;
	if (n->place > 0) {
		const struct node *above = &p->node[layer->node[n->place - 1]];

		*low = most(*low, above->row + above->rows + above->down + 1 + n->up);
	}
	if (n->place + 1 < layer->count) {
		const struct node *below = &p->node[layer->node[n->place + 1]];

		*high = below->row - below->up - 1 - n->down - n->rows;
	}
}

/* How straight the wires of a node are if its row is @row. */
static int straight_at(const struct planner *p, const struct index *index, int node, int row)
{
	int sum = 0;

	for (int side = 0; side < 2; side++) {
		const struct gap *gap = &p->gap[p->node[node].layer + side];
		const int base = index->first[2 * p->nodes + p->node[node].layer + side];

		for (int i = index->first[2 * node + side]; i >= 0; i = index->next[2 * i + side]) {
			const struct bond *e = &gap->edge[i - base];
			const int bend = side ? row + e->left_port - p->node[e->right].row - e->right_port :
					 row + e->right_port - p->node[e->left].row - e->left_port;

			sum += bend ? -(bend < 0 ? -bend : bend) : 20;
		}
	}
	return sum;
}

/* Moves a box to the row where most of its wires are straight. */
static void settle_box(struct planner *p, const struct index *index, int node)
{
	struct node *n = &p->node[node];
	int low, high, best = straight_at(p, index, node, n->row);

	free_rows(p, node, &low, &high);
	for (int side = 0; side < 2; side++) {
		const struct gap *gap = &p->gap[n->layer + side];
		const int base = index->first[2 * p->nodes + n->layer + side];

		for (int i = index->first[2 * node + side]; i >= 0; i = index->next[2 * i + side]) {
			const struct bond *e = &gap->edge[i - base];
			const int row = side ? p->node[e->right].row + e->right_port - e->left_port :
					p->node[e->left].row + e->left_port - e->right_port;

			if (row < low || row > high || straight_at(p, index, node, row) <= best)
				continue;
			best = straight_at(p, index, node, row);
			n->row = row;
		}
	}
}

/* The nodes from @first to @last of a wire that passes columns get one row. False: no row is free in all of
 * those columns. */
static bool settle_run(struct planner *p, int first, int last, int wish)
{
	int low = -LOOSE / 2, high = LOOSE;

	for (int i = first; i <= last; i++) {
		int least, greatest;

		free_rows(p, i, &least, &greatest);
		low = most(low, least);
		high = greatest < high ? greatest : high;
	}
	if (low > high)
		return false;
	wish = wish < low ? low : wish > high ? high : wish;
	for (int i = first; i <= last; i++)
		p->node[i].row = wish;
	return true;
}

/* A wire bends as seldom as it can. */
static void settle_net(struct planner *p, const struct net *net)
{
	const int ways = net->last - p->node[net->box].layer - 1;
	int wish = p->node[net->box].row + port_of(p->graph, net->pin);

	for (int i = 0; i < ways;) {
		int run = ways - i;

		while (run > 1 && !settle_run(p, net->first_way + i, net->first_way + i + run - 1, wish))
			run = run / 2;
		if (run == 1)
			settle_run(p, net->first_way + i, net->first_way + i, wish);
		i += run;
		wish = p->node[net->first_way + i - 1].row;
	}
}

/* Makes more wires straight without changing the order. */
static void settle(struct planner *p, const struct index *index)
{
	for (int l = 0; l < p->layers; l++)
		for (int i = 0; i < p->layer[l].count; i++)
			p->node[p->layer[l].node[i]].place = i;
	for (int pass = 0; pass < 4; pass++) {
		for (int n = 0; n < p->nets; n++)
			settle_net(p, &p->net[n]);
		for (int i = 0; i < p->nodes; i++)
			if (p->node[i].box >= 0 && !p->node[i].loose && !p->graph->box[p->node[i].box].at_row)
				settle_box(p, index, i);
	}
}

/* Boxes without wires stand above the first one of their column that has some, or at the top. */
static void place_loose(struct planner *p)
{
	int top = LOOSE;

	for (int i = 0; i < p->nodes; i++)
		if (p->node[i].row > -LOOSE / 2 && p->node[i].row - p->node[i].up < top)
			top = p->node[i].row - p->node[i].up;
	top = top == LOOSE ? 0 : top;
	for (int l = 0; l < p->layers; l++) {
		const struct layer *layer = &p->layer[l];
		int first = 0, next = top;

		while (first < layer->count && p->node[layer->node[first]].row <= -LOOSE / 2)
			first++;
		if (first < layer->count)
			next = p->node[layer->node[first]].row - p->node[layer->node[first]].up;
		for (int i = first - 1; i >= 0 && first < layer->count; i--) {
			struct node *node = &p->node[layer->node[i]];

			node->row = next - 1 - node->down - node->rows;
			next = node->row - node->up;
		}
		for (int i = 0; i < first && first == layer->count; i++) {
			struct node *node = &p->node[layer->node[i]];

			node->row = next + node->up;
			next = node->row + node->rows + node->down + 1;
		}
	}
}

static void shift_rows(struct planner *p)
{
	int top = 0, bottom = 0;
	bool any = false;

	for (int i = 0; i < p->nodes; i++) {
		const int above = p->node[i].row - p->node[i].up;

		top = !any || above < top ? above : top;
		any = true;
	}
	if (p->hinted && top > 0)
		top = 0;
	for (int i = 0; i < p->nodes; i++) {
		p->node[i].row -= top;
		bottom = most(bottom, p->node[i].row + p->node[i].rows + p->node[i].down + 1);
	}
	p->plan->rows = bottom;
}

/* Takes out the rows that nothing uses; not above a box whose row a person chose. */
static void close_rows(struct planner *p)
{
	int *shift = arena_alloc(&p->arena, (size_t)(p->plan->rows + 1) * sizeof(*shift));
	int kept = 0, gone = 0;

	if (!shift)
		return;
	for (int i = 0; i < p->nodes; i++) {
		const struct node *node = &p->node[i];

		for (int row = node->row - node->up; row <= node->row + node->rows + node->down; row++)
			shift[row] = 1;
		if (node->box >= 0 && p->graph->box[node->box].at_row)
			kept = most(kept, node->row);
	}
	for (int row = 0; row < p->plan->rows; row++) {
		gone += !shift[row] && row > kept;
		shift[row] = gone;
	}
	for (int i = 0; i < p->nodes; i++)
		p->node[i].row -= shift[p->node[i].row];
	p->plan->rows -= gone;
}

static void find_rows(struct planner *p)
{
	const size_t nodes = (size_t)p->nodes + 1;
	struct room room = { arena_alloc(&p->arena, nodes * sizeof(*room.wish)),
			     arena_alloc(&p->arena, nodes * sizeof(*room.sorted)),
			     arena_alloc(&p->arena, nodes * sizeof(*room.block)), { NULL, NULL } };
	int *best = arena_alloc(&p->arena, nodes * sizeof(*best));
	long most_straight = 0;

	if (!room.wish || !room.sorted || !room.block || !best || !index_edges(p, &room.index))
		return;
	if (p->hinted)
		sort_hints(p);
	for (int pass = 0; pass < 6; pass++) {
		const bool both = pass >= 3;
		long now;

		for (int l = p->layers - 1; l >= 0 && pass; l--)
			place_layer(p, &p->layer[l], both, true, &room);
		for (int l = 0; l < p->layers; l++)
			place_layer(p, &p->layer[l], true, both, &room);
		now = straight(p);
		if (pass && now <= most_straight)
			continue;
		most_straight = now;
		for (int i = 0; i < p->nodes; i++)
			best[i] = p->node[i].row;
	}
	for (int i = 0; i < p->nodes; i++)
		p->node[i].row = best[i];
	settle(p, &room.index);
	place_loose(p);
	shift_rows(p);
	close_rows(p);
}

/* ---- the widths of columns ---- */

static float width_of(const struct planner *p, enum fbd_text kind, const char *text)
{
	return text && *text ? p->metrics->width(p->metrics->context, kind, text) : 0;
}

/* Room that a box needs left of it, right of it, and for itself. */
static void measure_box(const struct planner *p, const struct fbd_box *box, float *lead, float *width, float *tail)
{
	const struct fbd_metrics *m = p->metrics;
	float in = 0, out = 0;

	*lead = *tail = 0;
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++) {
		const struct fbd_pin *pin = &p->graph->pin[i];
		const float name = width_of(p, FBD_TEXT_PIN, pin->name);
		const float operand = pin->operand ? width_of(p, FBD_TEXT_OPERAND, pin->operand) + m->stub : 0;
		float need = operand;

		if (!pin->output) {
			in = widest(in, name);
			*lead = widest(*lead, operand + (pin->negated ? m->circle : 0));
			continue;
		}
		out = widest(out, name);
		if (fbd_pin_shows_value(pin))
			need = widest(need, m->tail);
		for (int w = 0; w < p->graph->wire_count && pin->wire >= 0; w++)
			if (p->graph->wire[w].from_pin == i)
				need = widest(need, widest(width_of(p, FBD_TEXT_WIRE, p->graph->wire[w].name) + m->pad, m->tail));
		*tail = widest(*tail, need + (pin->negated ? m->circle : 0));
	}
	*width = widest(2 * m->pad + in + out + (in > 0 && out > 0 ? m->middle : 0),
			width_of(p, FBD_TEXT_TYPE, fbd_box_title(box)) + 2 * m->pad);
	*width = widest(*width, fbd_is_end(box) ? m->end_least : m->least);
	if (fbd_is_end(box))
		*width = widest(*width, width_of(p, FBD_TEXT_TARGET, box->target) +
				width_of(p, FBD_TEXT_TYPE, fbd_box_title(box)) + 2 * m->pad + (*box->type ? m->pad : 0));
	if (box->instance) /* its name may reach over both sides */
		*width = widest(*width, width_of(p, FBD_TEXT_INSTANCE, box->instance));
	if (box->kind == FBD_VALUE)
		*width = 0;
}

static void measure_layer(struct planner *p, struct layer *layer)
{
	float end = 0, behind = 0;

	for (int i = 0; i < layer->count; i++) {
		const int box = p->node[layer->node[i]].box;
		float lead, width, tail;

		if (box < 0)
			continue;
		measure_box(p, &p->graph->box[box], &lead, &width, &tail);
		p->plan->box[box].width = width;
		layer->lead = widest(layer->lead, lead);
		behind = widest(behind, width + tail);
		if (fbd_is_end(&p->graph->box[box]))
			end = widest(end, width);
	}
	for (int i = 0; i < layer->count; i++) {
		const int box = p->node[layer->node[i]].box;

		if (box >= 0 && fbd_is_end(&p->graph->box[box]))
			p->plan->box[box].width = end;
	}
	layer->width = layer->lead + behind;
}

/* ---- wires in a channel ---- */

/* The part of a net in one channel. */
struct item {
	int net;
	int left;            /* row where it comes in; -1: from a lane            */
	int *right;          /* rows where it leaves, and where to                */
	float *to;
	int rights;
	int lane;            /* row; -1: none                                    */
	int top, bottom;     /* of its vertical part                             */
	bool level;          /* it has none                                      */
	bool feedback;       /* it leads back                                    */
	bool inner;          /* its left end is the vertical part of item `after` */
	int after;           /* -1; that item                                    */
	int track;
	float from, x;
};

struct channel { struct item *item; int items; int *order; int ordered, tracks; };

static struct item *add_item(struct planner *p, struct channel *c, struct item item)
{
	struct item *new = arena_push(&p->arena, &c->item, &c->items, sizeof(*new));

	if (new)
		*new = item;
	return new;
}

static void add_right(struct planner *p, struct item *item, int row, float to)
{
	int count = item->rights;
	int *right = arena_push(&p->arena, &item->right, &count, sizeof(*right));
	float *x = arena_push(&p->arena, &item->to, &item->rights, sizeof(*x));

	if (!right || !x)
		return;
	*right = row;
	*x = to;
}

static void finish_item(struct item *item)
{
	item->top = item->left >= 0 ? item->left : item->rights ? item->right[0] : item->lane;
	item->bottom = item->top;
	for (int i = 0; i < item->rights; i++) {
		item->top = item->right[i] < item->top ? item->right[i] : item->top;
		item->bottom = most(item->bottom, item->right[i]);
	}
	if (item->lane >= 0)
		item->bottom = most(item->bottom, item->lane);
	item->level = item->top == item->bottom;
}

/* The parts of all nets in channel @g. Places at the right are computed later: `to` has the node. */
static void take_items(struct planner *p, int g, struct channel *c)
{
	const struct fbd_graph *graph = p->graph;

	for (int n = 0; n < p->nets; n++) {
		const struct net *net = &p->net[n];
		const int from = p->node[net->box].layer;
		const bool source = net->lane >= 0 && from + 1 == g;
		struct item *item;
		int left;

		if ((from < g && net->last >= g) || source) {
			left = left_node(net, p->node, g);
			item = add_item(p, c, (struct item){ .net = n, .after = -1, .lane = source ? net->lane : -1,
				.left = p->node[left].row + (left == net->box ? port_of(graph, net->pin) : 0),
				.from = left == net->box ? p->plan->pin[net->pin].x :
					p->layer[g - 1].x + p->layer[g - 1].width });
			for (int i = 0; i < p->gap[g].count && item && g < p->layers; i++) {
				const struct bond *e = &p->gap[g].edge[i];

				if (e->net == n)
					add_right(p, item, p->node[e->right].row + e->right_port, (float)e->right);
			}
		}
		if (net->lane < 0)
			continue;
		item = NULL;
		for (int pin = 0; pin < graph->pin_count; pin++) {
			const int box = graph->pin[pin].box;

			if (fbd_graph_source(graph, pin) != net->pin || is_forward(p, net->box, pin) ||
			    p->node[box].layer != g)
				continue;
			if (!item)
				item = add_item(p, c, (struct item){ .net = n, .after = -1, .left = -1, .lane = net->lane,
					.feedback = true });
			if (item)
				add_right(p, item, p->node[box].row + port_of(graph, pin), (float)box);
		}
	}
	for (int i = 0; i < c->items; i++)
		finish_item(&c->item[i]);
}

/* The item that leaves to the right where @a comes in from the left; -1: none. */
static int next_of(const struct channel *c, int a)
{
	if (c->item[a].left < 0 || c->item[a].inner || c->item[a].level)
		return -1;
	for (int b = 0; b < c->items; b++)
		for (int i = 0; i < c->item[b].rights && b != a && !c->item[b].level; i++)
			if (c->item[b].right[i] == c->item[a].left)
				return b;
	return -1;
}

static bool is_used(const struct channel *c, int row)
{
	for (int i = 0; i < c->items; i++) {
		if (c->item[i].left == row || c->item[i].lane == row)
			return true;
		for (int k = 0; k < c->item[i].rights; k++)
			if (c->item[i].right[k] == row)
				return true;
	}
	return false;
}

/* Divides an item in two, with a level part between them at a row that nothing else uses. */
static void divide(struct planner *p, struct channel *c, int a)
{
	const int left = c->item[a].left;
	int row = -1;
	struct item *new;

	for (int by = 1; row < 0 && by < p->lanes; by++) {
		if (left + by < p->lanes && !is_used(c, left + by))
			row = left + by;
		else if (left - by >= 0 && !is_used(c, left - by))
			row = left - by;
	}
	if (row < 0)
		row = p->plan->rows++;
	new = add_item(p, c, c->item[a]);
	if (!new)
		return;
	new->left = row;
	new->inner = true;
	new->after = a;
	c->item[a].rights = 0;
	c->item[a].right = NULL;
	c->item[a].to = NULL;
	c->item[a].lane = -1;
	add_right(p, &c->item[a], row, -1);
	finish_item(&c->item[a]);
	finish_item(new);
}

/* Items of which each must be left of the next, in a ring: one of them is divided. */
static void break_rings(struct planner *p, struct channel *c)
{
	const int items = c->items;
	int *seen = arena_alloc(&p->arena, (size_t)(items + 1) * sizeof(*seen));

	for (int i = 0; i < items && seen; i++) {
		int at = i;

		while (at >= 0 && at < items && !seen[at]) {
			seen[at] = i + 1;
			at = next_of(c, at);
		}
		if (at >= 0 && at < items && seen[at] == i + 1)
			divide(p, c, at);
	}
}

/* How many crossings more there are if @a is left of @b than if it is right of it. */
static int worse(const struct item *a, const struct item *b)
{
	int sum = 0;

	for (int i = 0; i < a->rights; i++)
		sum += a->right[i] > b->top && a->right[i] < b->bottom;
	sum += b->left > a->top && b->left < a->bottom;
	for (int i = 0; i < b->rights; i++)
		sum -= b->right[i] > a->top && b->right[i] < a->bottom;
	sum -= a->left > b->top && a->left < b->bottom;
	return sum;
}

static bool must_wait(const struct channel *c, const bool *placed, const int *next, int a)
{
	if (c->item[a].after >= 0 && !placed[c->item[a].after])
		return true;
	for (int i = 0; i < c->items; i++)
		if (next[i] == a && !placed[i])
			return true;
	return false;
}

/* The order of vertical parts, from the left. */
static void order_items(struct planner *p, struct channel *c)
{
	bool *placed = arena_alloc(&p->arena, (size_t)(c->items + 1) * sizeof(*placed));
	int *next = arena_alloc(&p->arena, (size_t)(c->items + 1) * sizeof(*next));
	int *cost = arena_alloc(&p->arena, (size_t)(c->items + 1) * sizeof(*cost));

	c->order = arena_alloc(&p->arena, (size_t)(c->items + 1) * sizeof(*c->order));
	if (!placed || !next || !cost || !c->order)
		return;
	for (int i = 0; i < c->items; i++) {
		next[i] = next_of(c, i);
		placed[i] = c->item[i].level;
		for (int k = 0; k < c->items && !c->item[i].level; k++)
			cost[i] += k == i || c->item[k].level ? 0 : worse(&c->item[i], &c->item[k]);
	}
	for (;;) {
		int best = -1;

		for (int i = 0; i < c->items; i++)
			if (!placed[i] && (best < 0 || cost[i] < cost[best]) && !must_wait(c, placed, next, i))
				best = i;
		if (best < 0)
			break;
		placed[best] = true;
		c->order[c->ordered++] = best;
		for (int i = 0; i < c->items; i++)
			if (!placed[i])
				cost[i] -= worse(&c->item[i], &c->item[best]);
	}
}

static void find_tracks(struct channel *c)
{
	for (int i = 0; i < c->ordered; i++) {
		struct item *item = &c->item[c->order[i]];

		for (int k = 0; k < i; k++) {
			const struct item *other = &c->item[c->order[k]];

			if (other->top <= item->bottom && item->top <= other->bottom)
				item->track = most(item->track, other->track + 1);
		}
		c->tracks = most(c->tracks, item->track + 1);
	}
}

/* ---- strokes ---- */

static void add_segment(struct planner *p, int pin, float x1, int row1, float x2, int row2, bool feedback)
{
	struct fbd_plan *plan = p->plan;
	struct fbd_segment *new;

	if (x1 == x2 && row1 == row2)
		return;
	new = arena_push(&plan->arena, &plan->segment, &plan->segment_count, sizeof(*new));
	if (new)
		*new = (struct fbd_segment){ pin, x1 < x2 ? x1 : x2, x1 < x2 ? x2 : x1, row1 < row2 ? row1 : row2,
					     row1 < row2 ? row2 : row1, feedback };
}

static void add_point(struct planner *p, struct fbd_point **points, int *count, struct fbd_point point)
{
	struct fbd_point *new = arena_push(&p->plan->arena, points, count, sizeof(*new));

	if (new)
		*new = point;
}

static void add_joints(struct planner *p, const struct item *item, int pin)
{
	for (int row = item->top; row <= item->bottom; row++) {
		int arms = (row > item->top) + (row < item->bottom) + (row == item->left);

		for (int i = 0; i < item->rights; i++)
			arms += item->right[i] == row;
		if (arms > 2)
			add_point(p, &p->plan->joint, &p->plan->joint_count, (struct fbd_point){ pin, item->x, row });
	}
}

/* Where node @node of column @g takes a wire that leaves the channel before it. */
static float right_end(const struct planner *p, int g, int node, int row)
{
	const int box = node < 0 ? -1 : p->node[node].box;

	if (box < 0)
		return p->layer[g].x + p->layer[g].width;
	for (int i = p->graph->box[box].first_pin; i < p->graph->box[box].first_pin + p->graph->box[box].pins; i++)
		if (!p->graph->pin[i].output && p->plan->pin[i].row == row)
			return p->plan->pin[i].x;
	return p->plan->box[box].x;
}

static void stroke_item(struct planner *p, int g, const struct channel *c, const struct item *item)
{
	struct net *net = &p->net[item->net];
	const float from = item->inner ? c->item[item->after].x : item->from;

	if (item->level) {
		for (int i = 0; i < item->rights; i++)
			add_segment(p, net->pin, from, item->left, right_end(p, g, (int)item->to[i], item->left),
				    item->left, item->feedback);
		return;
	}
	if (item->left >= 0)
		add_segment(p, net->pin, from, item->left, item->x, item->left, item->feedback);
	add_segment(p, net->pin, item->x, item->top, item->x, item->bottom, item->feedback);
	for (int i = 0; i < item->rights; i++)
		if (item->to[i] >= 0)
			add_segment(p, net->pin, item->x, item->right[i],
				    right_end(p, g, (int)item->to[i], item->right[i]), item->right[i],
				    item->feedback);
	add_joints(p, item, net->pin);
	if (item->lane >= 0 && !item->feedback)
		net->lane_from = item->x;
	if (item->lane >= 0 && item->feedback && (net->lane_to < 0 || item->x < net->lane_to))
		net->lane_to = item->x;
}

/* Lanes run below everything, back to the columns that read them. */
static void stroke_lanes(struct planner *p, const struct channel *channel)
{
	for (int n = 0; n < p->nets; n++) {
		const struct net *net = &p->net[n];

		if (net->lane < 0)
			continue;
		add_segment(p, net->pin, net->lane_to, net->lane, net->lane_from, net->lane, true);
		for (int g = 0; g <= p->layers; g++)
			for (int i = 0; i < channel[g].items; i++) {
				const struct item *item = &channel[g].item[i];

				if (item->net == n && item->feedback && item->x > net->lane_to)
					add_point(p, &p->plan->joint, &p->plan->joint_count,
						  (struct fbd_point){ net->pin, item->x, net->lane });
			}
	}
}

static void find_crossings(struct planner *p)
{
	const struct fbd_plan *plan = p->plan;

	for (int i = 0; i < plan->segment_count; i++) {
		const struct fbd_segment *v = &plan->segment[i];

		for (int k = 0; k < plan->segment_count && v->row1 != v->row2; k++) {
			const struct fbd_segment *h = &plan->segment[k];

			if (h->row1 == h->row2 && h->pin != v->pin && h->row1 > v->row1 && h->row1 < v->row2 &&
			    h->x1 < v->x1 && h->x2 > v->x1)
				add_point(p, &p->plan->crossing, &p->plan->crossing_count,
					  (struct fbd_point){ v->pin, v->x1, h->row1 });
		}
	}
}

/* ---- */

static void place_column(struct planner *p, int l, float x)
{
	struct layer *layer = &p->layer[l];

	layer->x = x;
	for (int i = 0; i < layer->count; i++) {
		const struct node *node = &p->node[layer->node[i]];
		struct fbd_at *at = node->box < 0 ? NULL : &p->plan->box[node->box];
		const struct fbd_box *box;

		if (!at)
			continue;
		*at = (struct fbd_at){ l, x + layer->lead, at->width, node->row, node->rows, node->row - node->up,
				       node->row + node->rows + node->down };
		box = &p->graph->box[node->box];
		for (int k = box->first_pin; k < box->first_pin + box->pins; k++)
			p->plan->pin[k] = (struct fbd_pin_at){ at->x + (p->graph->pin[k].output ? at->width : 0),
							       node->row + port_of(p->graph, k) };
	}
}

static void find_lanes(struct planner *p)
{
	p->lanes = p->plan->rows;
	for (int n = 0; n < p->nets; n++) {
		if (p->net[n].lane < 0)
			continue;
		p->net[n].lane = p->plan->rows++;
		p->net[n].lane_to = -1;
	}
}

/* Columns and channels get their x from the left to the right. */
static void route(struct planner *p)
{
	struct channel *channel = arena_alloc(&p->arena, (size_t)(p->layers + 1) * sizeof(*channel));
	float x = 0;

	for (int g = 0; g <= p->layers && channel; g++) {
		struct channel *c = &channel[g];
		const bool outside = g == 0 || g == p->layers;

		take_items(p, g, c);
		break_rings(p, c);
		order_items(p, c);
		find_tracks(c);
		for (int i = 0; i < c->items; i++)
			c->item[i].x = x + p->metrics->side + p->metrics->track * (float)c->item[i].track;
		if (!outside || c->tracks)
			x += 2 * p->metrics->side + p->metrics->track * (float)most(c->tracks - 1, 0);
		if (g < p->layers) {
			measure_layer(p, &p->layer[g]);
			place_column(p, g, x);
			x += p->layer[g].width;
		}
		for (int i = 0; i < c->items && !p->arena.failed; i++)
			stroke_item(p, g, c, &c->item[i]);
	}
	p->plan->width = x;
	p->plan->columns = p->layers;
	if (!channel || p->arena.failed)
		return;
	stroke_lanes(p, channel);
	find_crossings(p);
}

bool fbd_plan_make(const struct fbd_graph *graph, const struct fbd_metrics *metrics, struct fbd_plan *out)
{
	struct planner p = { .graph = graph, .metrics = metrics, .plan = out };
	bool good;

	*out = (struct fbd_plan){ .columns = 0 };
	arena_init(&out->arena);
	arena_init(&p.arena);
	out->box = arena_alloc(&out->arena, (size_t)(graph->box_count + 1) * sizeof(*out->box));
	out->pin = arena_alloc(&out->arena, (size_t)(graph->pin_count + 1) * sizeof(*out->pin));
	good = out->box && out->pin && make_nodes(&p);
	if (good) {
		find_order(&p);
		find_rows(&p);
		find_lanes(&p);
		route(&p);
	}
	good = good && !p.arena.failed && !out->arena.failed;
	arena_free(&p.arena);
	if (!good)
		fbd_plan_free(out);
	return good;
}

void fbd_plan_free(struct fbd_plan *plan)
{
	arena_free(&plan->arena);
	*plan = (struct fbd_plan){ .columns = 0 };
}
