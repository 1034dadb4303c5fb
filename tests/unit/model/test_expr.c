/* SPDX-License-Identifier: MIT
 *
 * test_expr - precedence, places of errors, and very long texts.
 */
#include "engine/model/expr.h"
#include "tests/tap.h"

static struct expr expr;
static struct diag_list diags;

/* The tree with all parentheses. Depth is bounded by the tests. */
static size_t print(char *out, size_t size, int at)
{
	static const char *const sign[] = {
		[EXPR_NEG] = "-", [EXPR_NOT] = "!", [EXPR_AND] = "&",
		[EXPR_XOR] = "^", [EXPR_OR] = "|", [EXPR_ARG] = NULL,
	};
	const struct expr_node *node = &expr.node[at];
	const char *word = node->op == EXPR_FN ? word_row(node->fn)->word :
						 sign[node->op];
	size_t len;

	if (node->op == EXPR_NAME || node->op == EXPR_LITERAL)
		return (size_t)snprintf(out, size, "%s%.*s",
					node->op == EXPR_LITERAL ? "#" : "",
					node->len, node->text);
	if (node->op == EXPR_INDEX) {
		len = node->right >= 0 ? print(out, size, node->right) : 0;
		len += (size_t)snprintf(out + len, size - len, "%.*s<", node->len,
					node->text);
		len += print(out + len, size - len, node->left);
		return len + (size_t)snprintf(out + len, size - len, ">%.*s",
					      node->tail.len, node->tail.len ?
					      node->tail.text : "");
	}
	if (node->op == EXPR_CALL) {
		len = (size_t)snprintf(out, size, "%.*s{", node->len, node->text);
		if (node->left >= 0)
			len += print(out + len, size - len, node->left);
		return len + (size_t)snprintf(out + len, size - len, "}");
	}
	if (node->op == EXPR_ARG) {
		len = node->right >= 0 ? print(out, size, node->right) : 0;
		len += (size_t)snprintf(out + len, size - len, "%s%.*s%s",
					node->right >= 0 ? ", " : "", node->len,
					node->text, node->len ? "=" : "");
		return len + print(out + len, size - len, node->left);
	}
	len = (size_t)snprintf(out, size, "(%s ", word);
	len += print(out + len, size - len, node->left);
	if (node->right >= 0) {
		len += (size_t)snprintf(out + len, size - len, " ");
		len += print(out + len, size - len, node->right);
	}
	return len + (size_t)snprintf(out + len, size - len, ")");
}

static const char *tree(const char *text)
{
	static char out[1000];
	struct diag place = { .line = 3 };

	diag_init(&diags);
	if (!expr_parse_text(text, strlen(text), &expr, &diags, place))
		return diags.count == 1 ? diag_code(diags.diag[0].id) :
					  "refused without exactly one message";
	print(out, sizeof(out), expr.root);
	return diags.count ? "diagnostic" : out;
}

static void precedence(void)
{
	CHECK_TEXT(tree("a"), "a");
	CHECK_TEXT(tree("a OR b AND c"), "(| a (& b c))");
	CHECK_TEXT(tree("a and b or c"), "(| (& a b) c)");
	CHECK_TEXT(tree("a XOR b & c OR d"), "(| (^ a (& b c)) d)");
	CHECK_TEXT(tree("a - b - c"), "(SUB (SUB a b) c)");
	CHECK_TEXT(tree("a - (b - c)"), "(SUB a (SUB b c))");
	CHECK_TEXT(tree("a + b * c MOD d / e"),
		   "(ADD a (DIV (MOD (MUL b c) d) e))");
	CHECK_TEXT(tree("-a * b"), "(MUL (- a) b)");
	CHECK_TEXT(tree("+a + +b"), "(ADD a b)");
	CHECK_TEXT(tree("-a ** b ** c * d"), "(MUL (EXPT (EXPT (- a) b) c) d)");
	CHECK_TEXT(tree("a - -5"), "(SUB a (- #5))");
	CHECK_TEXT(tree("NOT a = b"), "(EQ (! a) b)");
	CHECK_TEXT(tree("not (Up and Down)"), "(! (& Up Down))");
	CHECK_TEXT(tree("a < b = c >= d"), "(EQ (LT a b) (GE c d))");
	CHECK_TEXT(tree("a + 1 > b AND c <> d"),
		   "(& (GT (ADD a #1) b) (NE c d))");
	CHECK_TEXT(tree("a <= b OR NOT NOT c"), "(| (LE a b) (! (! c)))");
	CHECK_TEXT(tree("((a))"), "a");
	CHECK_TEXT(tree("Runout.ET > T#1.5s"), "(GT Runout.ET #T#1.5s)");
	CHECK_TEXT(tree("%IW2 + 16#FF"), "(ADD %IW2 #16#FF)");
	CHECK_TEXT(tree("TRUE XOR false"), "(^ #TRUE #false)");
	CHECK(expr.target == NULL);
}

static void indices(void)
{
	CHECK_TEXT(tree("a[1] + b[ i ] * %MW0[-3]"),
		   "(ADD a[1] (MUL b[ i ] %MW0[-3]))");
	CHECK_TEXT(tree("a[i + 1] > 2"), "(GT a<(ADD i #1)> #2)");
	CHECK_TEXT(tree("a[b[i] - c[(j)]]"), "a<(SUB b[i] c<j>)>");
	CHECK_TEXT(tree("NOT a[b[c[d[1]]]]"), "(! a<b<c<d[1]>>>)");
	CHECK_TEXT(tree("(a[(1 + 2) * 3])"), "a<(MUL (ADD #1 #2) #3)>");
	CHECK_TEXT(tree("a[-i]"), "a<(- i)>");
	CHECK_TEXT(tree("a[1"), "LD122");
	CHECK_TEXT(tree("a[1 + 2"), "LD122");
	CHECK_TEXT(tree("a[(1]"), "LD122");
	CHECK_TEXT(tree("a[(1])"), "LD122");
	CHECK_TEXT(tree("a]"), "LD122");
	CHECK_TEXT(tree("a[]"), "LD122");
	CHECK_TEXT(tree("a[1][2]"), "a[1][2]");
	CHECK_TEXT(tree("5[1]"), "LD122");
	CHECK_TEXT(tree("a[i := 1]"), "LD122");
	CHECK_TEXT(tree("a[i] := b"), "b");
	CHECK(expr.target_len == 4 && expr.target_index < 0);
	CHECK_TEXT(tree("a[i + 1] := b[i - 1]"), "b<(SUB i #1)>");
	CHECK(expr.target_len == 1 && expr.target_index == 2);
	CHECK_TEXT(tree("a[b[i]] := a[i]"), "a[i]");
	CHECK_TEXT(tree("a[i + ] := 1"), "LD122");
	CHECK_TEXT(tree("a[i] b := 1"), "LD122");
}

static void paths(void)
{
	CHECK_TEXT(tree("a[i + 1].b[2].c[j - 1].d > 0"),
		   "(GT a<(ADD i #1)>.b[2].c<(SUB j #1)>.d #0)");
	CHECK_TEXT(tree("a[i].b[j + 1]"), "a[i].b<(ADD j #1)>");
	CHECK_TEXT(tree("a[b[i + 1].c[j + 2]].d[-k]"),
		   "a<b<(ADD i #1)>.c<(ADD j #2)>>.d<(- k)>");
	CHECK_TEXT(tree("a[i + 1].b[j * 2].c := x[k + 1].y[2]"), "x<(ADD k #1)>.y[2]");
	CHECK(expr.target_len == 1 && expr.target_base >= 0 && expr.target_tail.len == 2 &&
	      expr.node[expr.target_base].inner &&
	      expr.node[expr.target_base].tail.len == 2 &&
	      expr.node[expr.target_base].right < 0);
	CHECK_TEXT(tree("a[i + 1].b := 2"), "#2");
	CHECK(expr.target_base < 0 && expr.target_index >= 0);
	CHECK_TEXT(tree("a[i + 1].b[j + 1"), "LD122");
	CHECK_TEXT(tree("a[i + 1].[j + 1]"), "LD122");
	CHECK_TEXT(tree("a[i + 1].b[j + 1)"), "LD122");
	CHECK_TEXT(tree("a[i + 1].b[j + ] := 1"), "LD122");
}

static void functions(void)
{
	CHECK_TEXT(tree("ABS(a)"), "ABS{a}");
	CHECK_TEXT(tree("now()"), "now{}");
	CHECK_TEXT(tree("LIMIT(0, ADD(a, b) * 2, -5) + ABS (c)"),
		   "(ADD LIMIT{#0, (MUL ADD{a, b} #2), (- #5)} ABS{c})");
	CHECK_TEXT(tree("f(x := a + 1, Y := (b))"), "f{x=(ADD a #1), Y=b}");
	CHECK_TEXT(tree("NOT f(a) AND a[f(i) + 1].b[g(j)]"),
		   "(& (! f{a}) a<(ADD f{i} #1)>.b<g{j}>)");
	CHECK_TEXT(tree("a[f(i)] := f(f(f(a)))"), "f{f{f{a}}}");
	CHECK_TEXT(tree("f(a, b"), "LD122");
	CHECK_TEXT(tree("f(a,)"), "LD122");
	CHECK_TEXT(tree("f(,a)"), "LD122");
	CHECK_TEXT(tree("f(a b)"), "LD122");
	CHECK_TEXT(tree("f(a))"), "LD122");
	CHECK_TEXT(tree("f(a]"), "LD122");
	CHECK_TEXT(tree("a, b"), "LD122");
	CHECK_TEXT(tree("(a, b)"), "LD122");
	CHECK_TEXT(tree("f(x := )"), "f{}");
	CHECK_TEXT(tree("f(x :=, y => , a, z=>)"), "f{a}");
	CHECK_TEXT(tree("f(x := , )"), "LD122");
	CHECK_TEXT(tree("f(a)(b)"), "LD122");
	CHECK_TEXT(tree("5(a)"), "LD122");
	CHECK_TEXT(tree("f(a) := b"), "LD122");
}

static void children_come_first(void)
{
	bool first = true;

	tree("a + (b - -c) * NOT d OR e > f");
	for (int i = 0; i < expr.count; i++)
		first &= expr.node[i].left < i && expr.node[i].right < i;
	CHECK(first);
	CHECK(expr.root == expr.count - 1);
}

static void targets(void)
{
	CHECK_TEXT(tree("Count := Count + 1"), "(ADD Count #1)");
	CHECK(expr.target_len == 5 && memcmp(expr.target, "Count", 5) == 0);
	CHECK_TEXT(tree("%MW4:=5"), "#5");
	CHECK(expr.target_len == 4 && memcmp(expr.target, "%MW4", 4) == 0);
	CHECK_TEXT(tree("a := b := c"), "LD122");
	CHECK_TEXT(tree("5 := a"), "LD122");
	CHECK_TEXT(tree("a :="), "LD122");
	CHECK_TEXT(tree(":= a"), "LD122");
}

static void malformed(void)
{
	static const char *const bad[] = {
		"", "(", ")", "()", "a +", "a b", "(a", "a)",
		"a ** ", "a AND", "AND a", "a OR OR b", "NOT", "-", "a $ b",
		"\"text\"", "a; b", "a\001", "(a,b)", "a = = b", "a := ", "MOD",
		"(a + b", "a & & b", "(* open",
	};

	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++)
		CHECK_AS(strcmp(tree(bad[i]), "LD122") == 0, bad[i]);
}

static void places(void)
{
	struct diag place = { .line = 3, .column = 10 };

	diag_init(&diags);
	CHECK(!expr_parse_text("a + ?", 5, &expr, &diags, place));
	CHECK(diags.diag[0].line == 3 && diags.diag[0].column == 14);
	CHECK_TEXT(diags.diag[0].arg, "?");
	place.column = 0;
	CHECK(!expr_parse_text("a + ?", 5, &expr, &diags, place));
	CHECK_AS(diags.diag[1].column == 0, "an unknown column stays 0 in the message");
}

static void stops_behind_it(void)
{
	static const char text[] = "a > 5 ] rest";
	struct diag place = { .line = 1 };
	struct lex lex;

	diag_init(&diags);
	lex_init(&lex, text, sizeof(text) - 1);
	lex_next(&lex);
	CHECK(expr_parse(&lex, &expr, &diags, place));
	CHECK(lex_is(&lex, "]"));
	CHECK(expr.node[expr.root].fn == FN_GT);
	lex_init(&lex, "a +\nb", 5);
	lex.newlines = true;
	lex_next(&lex);
	CHECK(!expr_parse(&lex, &expr, &diags, place));
	CHECK(diags.diag[0].column == 4 && diags.diag[0].arg[0] == '\0');
	lex_init(&lex, "a )", 3);
	lex_next(&lex);
	CHECK(expr_parse(&lex, &expr, &diags, place));
	CHECK_AS(lex_is(&lex, ")"),
		 "a closing parenthesis without an opening one is not read");
}

/* @piece @count times, then "a" and @close @count times. */
static const char *repeated(const char *piece, int count, const char *close)
{
	static char text[1 << 20];
	size_t used = 0;

	for (int i = 0; i < count; i++)
		used += (size_t)snprintf(text + used, sizeof(text) - used, "%s",
					 piece);
	used += (size_t)snprintf(text + used, sizeof(text) - used, "a");
	for (int i = 0; i < count; i++)
		used += (size_t)snprintf(text + used, sizeof(text) - used, "%s",
					 close);
	diag_init(&diags);
	if (expr_parse_text(text, used, &expr, &diags,
			    (struct diag){ .line = 1 }))
		return "good";
	return diags.count == 1 ? diag_code(diags.diag[0].id) : "?";
}

static void depth(void)
{
	CHECK_TEXT(repeated("(", LIMIT_EXPR_DEPTH, ")"), "good");
	CHECK_TEXT(repeated("(", LIMIT_EXPR_DEPTH + 1, ")"), "LD123");
	CHECK_TEXT(repeated("(", 100000, ")"), "LD123");
	CHECK_TEXT(repeated("(b + ", LIMIT_EXPR_DEPTH, ")"), "good");
	CHECK_TEXT(repeated("(b OR c AND d = ", LIMIT_EXPR_DEPTH, ")"),
		   "LD123");
	CHECK_TEXT(repeated("-", LIMIT_EXPR_DEPTH, ""), "good");
	CHECK_TEXT(repeated("f(", LIMIT_EXPR_DEPTH, ")"), "good");
	CHECK_TEXT(repeated("f(", LIMIT_EXPR_DEPTH + 1, ")"), "LD123");
	CHECK_TEXT(repeated("f(x + ", LIMIT_EXPR_DEPTH, ", 2)"), "good");
	CHECK_TEXT(repeated("f(x := b[", 50000, "])"), "LD123");
	CHECK_TEXT(repeated("f(b, ", 100000, ")"), "LD123");
	CHECK_TEXT(repeated("-", LIMIT_EXPR_DEPTH + 1, ""), "LD123");
	CHECK_TEXT(repeated("NOT ", 100000, ""), "LD123");
	CHECK_TEXT(repeated("b + ", LIMIT_EXPR_NODES / 2 - 1, ""), "good");
	CHECK_TEXT(repeated("b + ", LIMIT_EXPR_NODES / 2, ""), "LD123");
	CHECK_TEXT(repeated("b + ", 100000, ""), "LD123");
	CHECK_TEXT(repeated("", 1, ""), "good");
	CHECK_TEXT(repeated("x", LIMIT_NAME - 1, ""), "good");
	CHECK_TEXT(repeated("x", LIMIT_NAME, ""), "LD114");
	CHECK_TEXT(repeated("x", 1000000, ""), "LD114");
}

int main(void)
{
	precedence();
	indices();
	paths();
	functions();
	children_come_first();
	targets();
	malformed();
	places();
	stops_behind_it();
	depth();
	return tap_done();
}
