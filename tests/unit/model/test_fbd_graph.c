/* SPDX-License-Identifier: MIT
 *
 * test_fbd_graph - the boxes, pins and wires of networks, as text: `2 TON Delay: IN <- 1.Q` is box 2, whose input
 * comes from box 1.
 */
#include "engine/model/fbd_graph.h"
#include "engine/model/fbd.h"
#include "engine/text/text.h"
#include "tests/tap.h"

static char out[4000];
static size_t used;
static struct project *project;
static struct diag_list diags;

#define SAY(...) (used += (size_t)snprintf(out + used, used < sizeof(out) ? sizeof(out) - used : 0, __VA_ARGS__))

static void say_pin(const struct fbd_graph *graph, int index)
{
	const struct fbd_pin *pin = &graph->pin[index];
	const int source = fbd_graph_source(graph, index);

	SAY(" %s%s%s", pin->output ? ">" : "", pin->name, pin->open ? "?" : "");
	SAY("%s%s", pin->negated ? "/" : "", pin->previous ? "@" : "");
	if (pin->operand)
		SAY("=%s", pin->operand);
	if (source >= 0)
		SAY("<%d.%d", graph->pin[source].box, fbd_pin_number(graph, source));
	if (pin->output)
		for (int i = 0; i < graph->wire_count; i++)
			if (graph->wire[i].from_pin == index && graph->wire[i].name)
				SAY(":%s", graph->wire[i].name);
}

static const char *of(const struct fbd_box *box)
{
	static const char *const kinds[] = { "", "", "", "", "VALUE", "->", "->", "->", "", "" };

	return kinds[box->kind];
}

/* The graph of network @number (from 0) of a program with these declarations and lines. */
static const char *graph(const char *vars, const char *lines, int number)
{
	char text[4000];
	struct fbd_graph graph;

	snprintf(text, sizeof(text), "RUNGBOARD 1\nPROGRAM Main FBD\nVAR %s END_VAR\nNETWORK\n%s\nEND_PROGRAM\n"
		 "FUNCTION Twice : INT ST\nVAR_INPUT X : INT; END_VAR\nVAR_OUTPUT Big : BOOL; END_VAR\n"
		 "Twice := 2 * X;\nEND_FUNCTION\n", vars, lines);
	if (project)
		project_free(project);
	project = project_new("test");
	diag_init(&diags);
	used = 0;
	*out = 0;
	if (!text_read(project, "test", text, strlen(text), NULL, &diags))
		return "cannot be read";
	if (!fbd_graph_make(project, &project->pou[0], number, &graph))
		return "failed";
	for (int i = 0; i < graph.box_count; i++) {
		const struct fbd_box *box = &graph.box[i];

		SAY("%s%d%s%s%s%s%s%s%s", i ? "; " : "", i, *of(box) ? " " : "", of(box), *box->type ? " " : "",
		    box->type, box->instance ? " " : "", box->instance ? box->instance : "",
		    box->target ? " " : "");
		SAY("%s", box->target ? box->target : "");
		for (int k = box->first_pin; k < box->first_pin + box->pins; k++)
			say_pin(&graph, k);
	}
	fbd_graph_free(&graph);
	return out;
}

#define BITS "a, b, c, d, Q : BOOL; i, k : INT; Delay : TON; x : REAL;"

static void lines_become_boxes(void)
{
	CHECK_TEXT(graph(BITS, "Q := a", 0), "0 -> Q =a");
	CHECK_TEXT(graph(BITS, "Q := NOT a", 0), "0 -> Q /=a");
	CHECK_TEXT(graph(BITS, "Delay(IN := a, PT := T#3s)\nQ := Delay.Q", 0),
		   "0 TON Delay IN=a PT=T#3s >Q >ET?; 1 -> Q <0.1");
	CHECK_TEXT(graph(BITS, "Delay(IN := a, Q => Q, ET => T)\n", 0), "0 TON Delay IN=a PT? >Q=Q >ET:T");
	CHECK_TEXT(graph(BITS, "Delay()", 0), "0 TON Delay IN? PT? >Q? >ET?");
	CHECK_TEXT(graph(BITS, "Q S= a\nQ R= NOT b", 0), "0 -> S Q =a; 1 -> R Q /=b");
	CHECK_TEXT(graph(BITS, "RETURN IF a\nRETURN", 0), "0 RETURN =a; 1 RETURN ?");
}

static void expressions_become_boxes(void)
{
	CHECK_TEXT(graph(BITS, "Q := a AND NOT b AND c", 0), "0 AND =a /=b =c >; 1 -> Q <0.1");
	CHECK_TEXT(graph(BITS, "Q := (a OR b) AND c", 0), "0 OR =a =b >; 1 AND <0.1 =c >; 2 -> Q <1.1");
	CHECK_TEXT(graph(BITS, "Q := NOT (a OR b)", 0), "0 OR =a =b >; 1 NOT <0.1 >; 2 -> Q <1.1");
	CHECK_TEXT(graph(BITS, "Q := i + 1 > -5", 0), "0 + =i =1 >; 1 > <0.1 =-5 >; 2 -> Q <1.1");
	CHECK_TEXT(graph(BITS, "k := i - 1 - k", 0), "0 - =i =1 >; 1 - <0.1 =k >; 2 -> k <1.1");
	CHECK_TEXT(graph(BITS, "Q := R_EDGE(a)", 0), "0 R_EDGE =a >; 1 -> Q <0.1");
	CHECK_TEXT(graph(BITS, "Delay(IN := a XOR b)", 0), "0 XOR =a =b >; 1 TON Delay IN<0.1 PT? >Q? >ET?");
}

static void functions_have_all_pins(void)
{
	CHECK_TEXT(graph(BITS, "k := LIMIT(0, i, 10)", 0), "0 LIMIT MN=0 IN=i MX=10 >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(BITS, "k := LIMIT(MX := 10, IN := i)", 0), "0 LIMIT MN? IN=i MX=10 >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(BITS, "k := ADD(EN := a, 1, 2, 3)", 0),
		   "0 ADD EN=a IN1=1 IN2=2 IN3=3 >ENO? >OUT; 1 -> k <0.2");
	CHECK_TEXT(graph(BITS, "k := Twice(X := i, Big => Q)", 0), "0 Twice X=i >OUT >Big=Q; 1 -> k <0.1");
	CHECK_TEXT(graph(BITS, "x := INT_TO_REAL(i)", 0), "0 INT_TO_REAL IN=i >OUT; 1 -> x <0.1");
	CHECK_TEXT(graph(BITS, "k := Nothing(Foo := i)", 0), "0 Nothing Foo=i >OUT; 1 -> k <0.1");
}

static void names_are_wires(void)
{
	CHECK_TEXT(graph(BITS, "Low := a AND b\nQ := NOT low", 0), "0 AND =a =b >:Low; 1 -> Q /<0.1");
	CHECK_TEXT(graph(BITS, "Low := a\nQ := Low", 0), "0 VALUE =a >:Low; 1 -> Q <0.1");
	CHECK_TEXT(graph(BITS, "Delay(IN := a)\nDone := Delay.Q\nQ := Done\nc := Delay.Q", 0),
		   "0 TON Delay IN=a PT? >Q:Done >ET?; 1 -> Q <0.1; 2 -> c <0.1");
	CHECK_TEXT(graph(BITS, "k := SUB(EN := a, i, 1, ENO => Sure)\nQ := Sure", 0),
		   "0 SUB EN=a IN1=i IN2=1 >ENO:Sure >OUT; 1 -> k <0.2; 2 -> Q <0.1");
	CHECK_TEXT(graph(BITS, "Low := a AND b\nNETWORK\nQ := Low", 1), "0 -> Q =Low");
}

/* Who reads the output itself is behind its circle, too, and has one more. */
static void outputs_are_inverted(void)
{
	CHECK_TEXT(graph(BITS, "Delay(IN := a, NOT Q => Q)", 0), "0 TON Delay IN=a PT? >Q/=Q >ET?");
	CHECK_TEXT(graph(BITS, "Delay(IN := a, NOT Q => Idle)\nQ := Idle\nc := NOT Idle", 0),
		   "0 TON Delay IN=a PT? >Q/:Idle >ET?; 1 -> Q <0.1; 2 -> c /<0.1");
	CHECK_TEXT(graph(BITS, "Delay(NOT Q => Q)\nc := Delay.Q\nd := NOT Delay.Q", 0),
		   "0 TON Delay IN? PT? >Q/=Q >ET?; 1 -> c /<0.1; 2 -> d <0.1");
	CHECK_TEXT(graph(BITS, "c := Delay.Q\nDelay(NOT Q => Q)", 0), "0 -> c /@<1.1; 1 TON Delay IN? PT? >Q/=Q >ET?");
	CHECK_TEXT(graph(BITS, "Delay(NOT Q => Idle)\nDone := Delay.Q\nQ := Done", 0),
		   "0 TON Delay IN? PT? >Q/:Idle >ET?; 1 VALUE /<0.1 >:Done; 2 -> Q <1.1");
	CHECK_TEXT(graph(BITS, "k := SUB(EN := a, i, 1, NOT ENO => Bad)\nQ := Bad", 0),
		   "0 SUB EN=a IN1=i IN2=1 >ENO/:Bad >OUT; 1 -> k <0.2; 2 -> Q <0.1");
}

static void feedback_is_marked(void)
{
	CHECK_TEXT(graph(BITS, "Sum := ADD(PREVIOUS(Sum), i)\nk := Sum", 0),
		   "0 ADD IN1@<0.1 IN2=i >OUT:Sum; 1 -> k <0.1");
	CHECK_TEXT(graph(BITS, "Q := a AND NOT Delay.Q\nDelay(IN := Q)", 0),
		   "0 AND =a /@<2.1 >; 1 -> Q <0.1; 2 TON Delay IN=Q PT? >Q >ET?");
	CHECK_TEXT(graph(BITS, "Q := Low\nLow := a AND b", 0), "0 -> Q @<1.1; 1 AND =a =b >:Low");
}

/* The bytes that @pin of box @box of the first network is written with. */
static const char *bytes(const char *lines, int box, int pin)
{
	static char text[200];
	struct fbd_graph g;
	const struct fbd_pin *p;
	const struct st_item *item;

	graph(BITS, lines, 0);
	if (!fbd_graph_make(project, &project->pou[0], 0, &g))
		return "failed";
	p = &g.pin[g.box[box].first_pin + pin];
	item = &project->pou[0].st->item[g.box[box].item];
	snprintf(text, sizeof(text), "%d:%d %.*s", p->line, p->column, p->len,
		 project_text(project, item->text) + p->at);
	fbd_graph_free(&g);
	return text;
}

#define MORE BITS " A : ARRAY[0..3] OF INT; P : REF_TO INT; D : ARRAY[0..1] OF TON; t : TIME;"

static void operands_are_whole(void)
{
	CHECK_TEXT(graph(MORE, "A[i + 1] := k + 1", 0), "0 + =k =1 >; 1 -> A[i + 1] <0.1");
	CHECK_TEXT(graph(MORE, "k := A[0] + D[0].ET", 0), "0 + =A[0] =D[0].ET >; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "k := P^ + 1", 0), "0 + =P^ =1 >; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "Q := NOT (A[1] > 2) AND b", 0), "0 > =A[1] =2 >; 1 NOT <0.1 >; 2 AND <1.1 =b >; 3 -> Q <2.1");
	CHECK_TEXT(graph(MORE, "Q := %IX0.0 AND %MX1.1", 0), "0 AND =%IX0.0 =%MX1.1 >; 1 -> Q <0.1");
	CHECK_TEXT(graph(MORE, "%QX0.0 := a", 0), "0 -> %QX0.0 =a");
	CHECK_TEXT(graph(MORE, "Delay(IN := a, Q => A[1])", 0), "0 TON Delay IN=a PT? >Q=A[1] >ET?");
	CHECK_TEXT(graph(MORE, "Q := Delay.ET > T#1s", 0), "0 > =Delay.ET =T#1s >; 1 -> Q <0.1");
	CHECK_TEXT(graph(MORE, "Q := Delay.NOPE", 0), "0 -> Q =Delay.NOPE");
	CHECK_TEXT(graph(MORE, "Q := Other.Q", 0), "0 -> Q =Other.Q");
	CHECK_TEXT(graph(MORE, "Q := (a)", 0), "0 -> Q =a");
	CHECK_TEXT(graph(MORE, "k := NOT i", 0), "0 -> k /=i");
}

static void signs_become_boxes(void)
{
	CHECK_TEXT(graph(MORE, "k := -i", 0), "0 - =i >; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "k := -(i + 1)", 0), "0 + =i =1 >; 1 - <0.1 >; 2 -> k <1.1");
	CHECK_TEXT(graph(MORE, "x := i ** 2 / 3", 0), "0 ** =i =2 >; 1 / <0.1 =3 >; 2 -> x <1.1");
	CHECK_TEXT(graph(MORE, "k := i MOD 3 * 2 - -1", 0), "0 MOD =i =3 >; 1 * <0.1 =2 >; 2 - <1.1 =-1 >; 3 -> k <2.1");
	CHECK_TEXT(graph(MORE, "Q := a & b", 0), "0 AND =a =b >; 1 -> Q <0.1");
	CHECK_TEXT(graph(MORE, "Q := a XOR (b XOR c)", 0), "0 XOR =b =c >; 1 XOR =a <0.1 >; 2 -> Q <1.1");
	CHECK_TEXT(graph(MORE, "Q := a AND_THEN b OR_ELSE c", 0), "0 AND_THEN =a =b >; 1 OR_ELSE <0.1 =c >; 2 -> Q <1.1");
	CHECK_TEXT(graph(MORE, "Q := a OR b AND c", 0), "0 AND =b =c >; 1 OR =a <0.1 >; 2 -> Q <1.1");
	CHECK_TEXT(graph(MORE, "Q := i >= k AND i <= 3 AND i <> k AND i = 1", 0),
		   "0 >= =i =k >; 1 <= =i =3 >; 2 <> =i =k >; 3 = =i =1 >; 4 AND <0.1 <1.1 <2.1 <3.1 >; 5 -> Q <4.1");
	CHECK_TEXT(graph(MORE, "Q := NOT (NOT a)", 0), "0 NOT /=a >; 1 -> Q <0.1");
	CHECK_TEXT(graph(MORE, "Q S= a AND b", 0), "0 AND =a =b >; 1 -> S Q <0.1");
	CHECK_TEXT(graph(MORE, "RETURN IF a AND b", 0), "0 AND =a =b >; 1 RETURN <0.1");
}

static void calls_have_all_pins(void)
{
	CHECK_TEXT(graph(MORE, "k := MAX(i, k, 3, 4)", 0), "0 MAX IN1=i IN2=k IN3=3 IN4=4 >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "k := MAX(IN1 := i, IN3 := k)", 0), "0 MAX IN1=i IN2? IN3=k >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "k := SEL(G := a, IN0 := i, IN1 := k)", 0), "0 SEL G=a IN0=i IN1=k >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "MOVE(EN := a, i)", 0), "0 MOVE EN=a IN=i >ENO? >OUT?");
	CHECK_TEXT(graph(MORE, "k := LIMIT(IN := ADD(i, 1), MN := 0, MX := 5)", 0),
		   "0 ADD IN1=i IN2=1 >OUT; 1 LIMIT MN=0 IN<0.1 MX=5 >OUT; 2 -> k <1.1");
	CHECK_TEXT(graph(MORE, "k := Twice(EN := a, X := i, ENO => Q)", 0),
		   "0 Twice EN=a X=i >ENO=Q >OUT >Big?; 1 -> k <0.2");
	CHECK_TEXT(graph(MORE, "k := Twice(X := )", 0), "0 Twice X? >OUT >Big?; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "k := Twice(X := i, Big => Low)\nQ := Low", 0),
		   "0 Twice X=i >OUT >Big:Low; 1 -> k <0.1; 2 -> Q <0.2");
	CHECK_TEXT(graph(MORE, "Nothing(a)", 0), "0 Nothing =a >OUT?");
	CHECK_TEXT(graph(MORE, "k := Nothing()", 0), "0 Nothing >OUT; 1 -> k <0.1");
	CHECK_TEXT(graph(MORE, "Delay(IN := , PT := T#3s)", 0), "0 TON Delay IN? PT=T#3s >Q? >ET?");
	CHECK_TEXT(graph(MORE, "Delay(IN := a, Q => )", 0), "0 TON Delay IN=a PT? >Q? >ET?");
	CHECK_TEXT(graph(MORE, "Delay(a, T#3s)", 0), "0 TON Delay IN=a PT=T#3s >Q? >ET?");
	CHECK_TEXT(graph(MORE, "Delay(NOPE := a)", 0), "0 TON Delay IN? PT? NOPE=a >Q? >ET?");
	CHECK_TEXT(graph(MORE, "Low := Delay.Q\nNext := Low\nQ := Next", 0), "0 VALUE =Delay.Q >:Low:Next; 1 -> Q <0.1");
	CHECK_TEXT(graph(MORE, "Low := ADD(i, 1)\nk := Low + Low", 0), "0 ADD IN1=i IN2=1 >OUT:Low; 1 + <0.1 <0.1 >; 2 -> k <1.1");
	CHECK_TEXT(graph(MORE, "k := ADD(PREVIOUS(k), 1)", 0), "0 ADD IN1@=k IN2=1 >OUT; 1 -> k <0.1");
}

static void places_are_known(void)
{
	CHECK_TEXT(bytes("Q := a AND (b OR NOT c)", 1, 1), "5:12 (b OR NOT c)");
	CHECK_TEXT(bytes("Q := a AND (b OR NOT c)", 0, 1), "5:18 NOT c");
	CHECK_TEXT(bytes("Delay(IN := (a), PT := T#3s)", 0, 0), "5:13 (a)");
	CHECK_TEXT(bytes("k := ADD(i + 1, 2)", 1, 0), "5:10 i + 1");
	CHECK_TEXT(bytes("k := ADD(ADD(i, 3), 2)", 1, 0), "5:10 ADD(i, 3)");
}

int main(void)
{
	lines_become_boxes();
	expressions_become_boxes();
	functions_have_all_pins();
	names_are_wires();
	outputs_are_inverted();
	feedback_is_marked();
	operands_are_whole();
	signs_become_boxes();
	calls_have_all_pins();
	places_are_known();
	project_free(project);
	return tap_done();
}
