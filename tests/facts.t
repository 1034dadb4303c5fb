#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# facts.t - numbers, names and lists in the documents are those of the sources. tests/docs.t runs
# what the documents show, tests/architecture.t looks for the names of ARCHITECTURE.md.
#
# A fact is a pattern with one group, which must occur in a document, and the value that the
# sources have for it. If a sentence with a fact changes, change its pattern here.
use strict;
use warnings;
use utf8;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use JSON::PP;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

binmode $_, ':encoding(UTF-8)' for Test::More->builder->output, Test::More->builder->failure_output;
chdir dirname(__FILE__) . '/..' or die;
my $build = $ENV{BUILD} // 'build';
my $ladder = $ENV{LADDER} // "$build/ladder";
my @documents = ('README.md', 'ARCHITECTURE.md', glob('docs/*.md'));
my %text = map { $_ => slurp($_, ':encoding(UTF-8)') } @documents;
# A document without its blocks.
my %prose = map { $_ => $text{$_} =~ s/^```.*?^```//gmsr } @documents;
my %word = (once => 1, two => 2, third => 3, four => 4, eight => 8, ten => 10, hundred => 100);

# The value of a C expression of numbers, such as (64u << 20).
sub value {
	my ($expression) = @_;
	$expression =~ s{/\*.*}{};
	$expression =~ s/\b(?:INT64_C|UINT64_C|G_GINT64_CONSTANT)\b//g;
	$expression =~ s/\b(\d+)[uUlL]+\b/$1/g;
	return $expression =~ /^[\d\s()<*+-]+$/ ? eval $expression : undef;
}

# NAME of a #define, or of an enumerator with a number, in a file.
sub constant {
	my ($path, $name) = @_;
	my $source = slurp($path) // die "$path: $!";
	return value($1) if $source =~ /^#define\s+\Q$name\E\s+(.+)$/m || $source =~ /\b\Q$name\E\s*=\s*(\d+)/;
	die "$path has no number for $name\n";
}
sub limit { return constant('runtime/engine/base/limits.h', "LIMIT_$_[0]") }

# @pattern: its group is a number, with commas or as a word.
sub fact {
	my ($path, $pattern, $want) = @_;
	my ($got) = $text{$path} =~ $pattern;
	if (!defined $got) {
		fail("$path: $pattern is there");
		return;
	}
	$got =~ tr/,//d if $got =~ /^[\d,]+$/;
	is($word{$got} // $got, $want, "$path: $pattern");
}

sub list_is {
	my ($what, $got, $want) = @_;
	is(join(' ', sort @$got), join(' ', sort @$want), $what);
}

# ---- limits ----
fact('README.md', qr/up to (\d+) columns by \d+ rows a rung/, limit('COLS'));
fact('README.md', qr/up to \d+ columns by (\d+) rows a rung/, limit('ROWS'));
fact('docs/rung-file.md', qr/and at most (\d+) elements/, limit('ELEMENTS'));
fact('docs/rung-file.md', qr/Up to (\w+) indices of an operand/, limit('INDICES'));
fact('docs/rung-file.md', qr/and signs nest up to (\d+) deep\./, limit('EXPR_DEPTH'));
fact('docs/rung-file.md', qr/Parentheses nest, (\d+) deep/, limit('IL_DEPTH'));
fact('docs/rung-file.md', qr/has at most (\d+) tasks/, limit('TASKS') - 1); # one is for programs without a task
fact('docs/rung-file.md', qr/\((\d+) µs to 24 h\)/, limit('TICK') / 1000);
fact('docs/rung-file.md', qr/µs to (\d+) h\)/, limit('INTERVAL') / 3600e9);
fact('docs/rung-file.md', qr/All areas together have at most (\d+) MiB/, limit('AREAS') >> 20);
fact('docs/rung-file.md', qr/is at most (\d+) bytes long/, limit('NAME'));
fact('docs/language.md', qr/longer than its variable, or than (\d+) bytes/, constant('runtime/engine/base/iec.h', 'IEC_STRING_MOST'));
fact('docs/language.md', qr/Loops may nest, (\w+) deep/, limit('LOOPS'));
fact('docs/language.md', qr/Subroutines may call one another, (\d+) deep/, limit('CALLS'));
fact('docs/language.md', qr/Calls nest up to (\d+) deep/, limit('CALLS'));
fact('docs/language.md', qr/as boxes with 2 to (\d+) inputs/, limit('FN_INPUTS'));
fact('docs/language.md', qr/`MAX` take up to (\d+) inputs/, limit('FN_INPUTS'));
fact('docs/language.md', qr/It is never below (\d+) µs/, limit('TICK') / 1000);
fact('docs/sfc.md', qr/at most (\d+) times a scan; then come the actions/, limit('ROUNDS'));
fact('docs/sfc.md', qr/Macro-steps may nest, (\d+) deep/, limit('MACROS'));
fact('docs/sfc.md', qr/up to (\d+); LD455/, limit('MARKINGS'));
fact('docs/from-classicladder.md', qr/until none fires, at most (\d+) times a scan/, limit('ROUNDS'));
fact('docs/code-image.md', qr/position-independent, at most (\d+) MiB/, limit('IMAGE') >> 20);
fact('docs/code-image.md', qr/together at most (\d+) MiB/, limit('AREAS') >> 20);
fact('docs/code-image.md', qr/not recursive and at most (\d+) deep/, limit('CALLS'));

# Messages that name a limit.
for (['LD140', qr/at most (\d+) elements/, 'ELEMENTS'], ['LD145', qr/more than (\d+) files/, 'INCLUDES']) {
	my ($code, $pattern, $limit) = @$_;
	my ($message) = slurp('runtime/engine/diag.def') =~ /^DIAG\(\w+,\s*"$code",.*?"((?:[^"\\]|\\.)*)"\)/m;
	is(($message =~ $pattern)[0], limit($limit), "$code: LIMIT_$limit");
}

# ---- other numbers ----
fact('docs/sfc.md', qr/more than (\d+) contacts in a row/,
     constant('runtime/engine/exchange/classic/sfc_ladder_parts.h', 'LAD_COLS'));
fact('docs/from-classicladder-export.md', qr/\*\*Expressions\*\* of more than (\d+) bytes/,
     constant('runtime/engine/exchange/classic/classic_write.h', 'CLASSIC_EXPRESSION'));
fact('docs/editor.md', qr/keeps its last ([\d,]+) scans/, constant('editor-gtk/sim/sim.h', 'SIM_SCANS'));
my ($control_scans, $shift_scans) = slurp('editor-gtk/live/timing_area.c') =~ /CONTROL_MASK \? (\d+) : state & GDK_SHIFT_MASK \? (\d+)/;
fact('docs/editor.md', qr/from scan to scan \(with `Shift` (\w+), with/, $shift_scans);
fact('docs/editor.md', qr/with\s`Ctrl` a (\w+)\), `Home`/, $control_scans);
fact('docs/editor.md', qr/All programs together take (\d+) MB at most/,
     constant('editor-gtk/sim/sim.h', 'SIM_BYTES') >> 20);
fact('docs/editor.md', qr/draft, (\d+) ms after the last change/, constant('editor-gtk/document/draft.c', 'PAUSE_MS'));
fact('docs/editor.md', qr/at the latest (\d+) ms after the first one/, constant('editor-gtk/document/draft.c', 'LATEST_MS'));
fact('docs/editor.md', qr/slow motion \(1 to (\d+) scans a second\)/,
     (slurp('editor-gtk/ui/sim_pace.ui') =~ /id="speed".*?name="upper">(\d+)</s)[0]);
fact('docs/pictures.md', qr/type is smaller than (\d+) pt/,
     int((slurp('editor-gtk/draw/pages.c') =~ /PAGE_LEAST .*?([\d.]+) pt/)[0]));
fact('docs/boards.md', qr/keeps the last value; the (\w+) in a row is a FAULT/, constant('hal/hal.h', 'HAL_FAILURES'));
fact('docs/boards.md', qr/tries (\w+) a second to take the/, 1e9 / constant('runtime/ladderd/cycle.c', 'TEND_NS'));
fact('docs/boards.md', qr/call for all inputs of a chip and one for all its outputs, up to (\d+) lines/,
     constant('hal/drivers.h', 'REQUEST_LINES'));
fact('docs/boards.md', qr/two places of (\d+) KB or more/, constant('runtime/engine/scan/retain.h', 'RETAIN_PAGE') >> 10);
fact('docs/boards.md', qr/needs (\d+) KB of stack/, constant('runtime/ladderd/main.c', 'STACK_BYTES') >> 10);
my $unit = slurp('packaging/ladderd.service');
fact('docs/boards.md', qr/with `WatchdogSec=(\d+)` in the unit/, $unit =~ /^WatchdogSec=(\d+)$/m);
fact('docs/boards.md', qr/The unit allows up to (\d+) \|/, ($unit =~ /^LimitRTPRIO=(\d+)$/m)[0] - 1);
is(($unit =~ /^LimitRTPRIO=(\d+)$/m)[0], constant('runtime/guard/main.c', 'PRIORITY'), 'the unit allows the priority of the guard');
fact($_, qr/at most (\d+) KB/, (slurp('tests/targets/sizes') =~ /SMALL=1, all words' (\d+)/)[0] >> 10)
	for 'README.md', 'docs/boards.md';

# ---- ladderd --help: options, ranges, defaults ----
my $options = slurp('runtime/ladderd/options.c');
my ($help) = $options =~ /^"Usage: ladderd(.*?)^}/ms;
my ($of_link) = $options =~ /^#define LINK_HELP \\\n((?:"[^\n]*\n)+)/m; # not on small boards
$help =~ s/^LINK_HELP\n/$of_link/m;
my %row;
while ($options =~ /^\t\{ "(--[a-z-]+)",\s+(\w+),\s+AT\([\w.]+\),\s+(\w+),\s+(\w+) \}/mg) {
	$row{$1} = { kind => $2, least => $3, most => $4 };
}
list_is('ladderd --help names every option', [$help =~ /^"  (?:--help, )?(--[a-z-]+)/mg, '--help'], [keys %row]);
my %ns = (us => 1e3, ms => 1e6, s => 1e9, m => 60e9, h => 3600e9);
sub bound { return $_[0] =~ /^\d+$/ ? $_[0] : constant($_[0] =~ /^STORE/ ? 'runtime/ladderd/store.h' : 'runtime/ladderd/options.c', $_[0]) }
for my $option (sort keys %row) {
	my ($kind, $least, $most) = @{$row{$option}}{qw(kind least most)};
	my ($about) = $help =~ /^"  \Q$option\E (.*?)(?=^"  --|^"\\n")/ms;
	next if $kind eq 'FLAG' || $kind eq 'TEXT' || $option eq '--scans';
	my ($from, $unit, $to, $until) = $about =~ /(\d+)(us|ms|s|m|h)? to (\d+)(us|ms|s|m|h)?/;
	is($from * ($ns{$unit // ''} // 1), bound($least), "ladderd --help: the least $option");
	is($to * ($ns{$until // ''} // 1), bound($most), "ladderd --help: the most $option");
}
my ($watchdog) = $options =~ /options->watchdog = (\d+);/;
my ($retain_ns) = $options =~ /options->retain\.period_ns = (INT64_C\(\d+\));/;
like($help, qr/default $watchdog\\n/, 'ladderd --help: the default of --watchdog');
my $retain_s = value($retain_ns) / 1e9;
like($help, qr/10ms to 1h; default ${retain_s}s\\n/, 'ladderd --help: the default of --retain-period');
fact('docs/boards.md', qr/not sooner than `--retain-period` \((\d+) s\)/, $retain_s);
fact('docs/language.md', qr/than `--watchdog` \((\d+)\) intervals/, $watchdog);

# ---- the code image ----
my $code = slurp('runtime/engine/scan/code.h');
fact('docs/code-image.md', qr/^\| 8 \| 4 \| version, (\d+) \|/m, constant('runtime/engine/scan/code.h', 'CODE_VERSION'));
my ($kinds) = $code =~ /^enum code_section_kind \{(.*?)^\}/ms;
my @kinds = $kinds =~ /^\t(CODE_\w+)/mg;
my $sections = @kinds; # the first is 1, the last is the count
my %size = (char => 1, uint32_t => 4, 'struct code_section' => 8);
my %count = (CODE_AREAS => constant('runtime/engine/scan/code.h', 'CODE_AREAS'), CODE_SECTION_COUNT => $sections);
my ($header) = $code =~ /^struct code_header \{(.*?)^\}/ms;
my ($at, %field) = (0);
while ($header =~ /^\t(char|uint32_t|struct code_section) ([^;]+);/mg) {
	my ($type, $names) = ($1, $2);
	for (split /, */, $names) {
		$field{$at} = $_;
		$at += $size{$type} * (/\[(\w+)\]/ ? $count{$1} // $1 : 1);
	}
}
my $end = 0;
while ($text{'docs/code-image.md'} =~ /^\| (\d+) \| (\d+)(?: × (\d+))? \| /mg) {
	my ($offset, $bytes) = ($1, $2 * ($3 // 1));
	ok($offset == $end && defined $field{$offset}, "docs/code-image.md: a field of the header at $offset");
	$end += $bytes;
}
is($end, $at, 'docs/code-image.md: the size of the header');
my @shown = $text{'docs/code-image.md'} =~ /^\| \d+ ([a-z][a-z ,]*) \| [^\n]*\|$/mg;
my $names = slurp('runtime/ladder/cmd_code.c');
my %name = $names =~ /\[(CODE_\w+)\] = "([^"]+)"/g;
is(join('; ', @shown), join('; ', map { $name{$_} } @kinds[0 .. $sections - 2]), 'docs/code-image.md: the sections, as `ladder code` names them');
my ($first) = grep { $kinds[$_ - 1] eq 'CODE_WATCH' } 1 .. $sections;
is(join(' ', $text{'docs/code-image.md'} =~ /^\| (\d+) [^\n]*\| yes \|$/mg), join(' ', $first .. $sections - 1), 'docs/code-image.md: the optional sections');
fact('docs/code-image.md', qr/`ladder build --small` drops sections (\d+ to \d+)/, "$first to " . ($sections - 1));
my ($table) = $text{'docs/code-image.md'} =~ /^\| instruction \|.*?\n(.*?)\n\n/ms;
my @instructions = map { s/ [a-z].*//r } map { split /, (?=[A-Z])/ } map { s/^\| ([^|]+) \|.*/$1/r } grep { !/^\|-/ } split /\n/, $table;
list_is('docs/code-image.md: the instructions', [map { split /, / } @instructions],
	[slurp('runtime/engine/catalog.def') =~ /^VM\((\w+),/mg]);

my ($cases) = slurp('runtime/engine/scan/code_text.c') =~ /^uint32_t code_words.*?switch.*?\{(.*?)^\t\}/ms;
my %length = (END => 1);
while ($cases =~ /((?:\s*case VM_\w+:)+)\s*return (.*?);/g) {
	my ($operations, $length) = ($1, $2);
	$length{$_} = $length for $operations =~ /VM_(\w+)/g;
}
for (grep { !/^\|-/ } split /\n/, $table) {
	my (undef, $operations, $operands) = split /\s*\|\s*/;
	my $more = $operands =~ s/(?:, )?\w+ …| ?n × (\(.*\))// ? $1 // '(1)' : '';
	my $length = 1 + (() = $operands =~ /[^,]+/g);
	my $each = () = $more =~ /\w+/g;
	for my $operation (map { s/ [a-z].*//r } split /, (?=[A-Z])/, $operations) {
		my ($fixed, $plus, $times) = $length{$operation} =~ /^(\d+)( \+ (?:(\d+) \* )?(?:n$|\(n >> 8))?/;
		is("$length $each", "$fixed " . ($plus ? $times // 1 : 0), "docs/code-image.md: the operands of $operation");
	}
}
fact('docs/code-image.md', qr/have (\w+) more operands at the end/, ($length{AGET} =~ /(\d+) \* \(n >> 1\b/)[0]);

# ---- words ----
my $words = decode_json(scalar `$ladder words --json`);
my %words = map { $_ => 0 } 'function', 'function block';
$words{$_->{kind}}++ for grep { $_->{word} !~ /^CL_/ } @$words; # those are for imports
fact('README.md', qr/of your own; (\d+)\n  functions/, $words{function});
fact('README.md', qr/and (\d+) function blocks, from SR to PID/, $words{'function block'});
my $usual = 0;
$usual += $_->{bytes} for grep { $_->{kind} eq 'area' } @$words;
fact('docs/rung-file.md', qr/\(#addresses\): (\d+) bytes in all/, $usual);
my %area = map { $_->{word} => $_ } grep { $_->{kind} eq 'area' } @$words;
my ($area_table) = $text{'docs/rung-file.md'} =~ /^\| area \| letters \|.*?\n\|-.*?\n(.*?)\n\n/ms;
my %described;
for (split /\n/, $area_table) {
	my (undef, undef, $letters, undef, $bytes, $range) = split / *\| */;
	for my $area ($letters =~ /`(\w+)`/g) {
		my ($usual, $most) = ($bytes =~ /^(\d+)/, $range =~ /^\d+ to (\d+)/ ? $1 : $bytes);
		is("$usual $most", "$area{$area}{bytes} $area{$area}{most_bytes}", "docs/rung-file.md: the sizes of area $area");
		$described{$area} = 1;
	}
}
list_is('docs/rung-file.md: the areas', [keys %described], [keys %area]);
my ($qualifiers) = $text{'docs/rung-file.md'} =~ /^qualifier += (.*)$/m;
my ($sfc) = slurp('runtime/engine/model/sfc.c') =~ /^\t("N", "S", [^\n]*),$/m;
is(join(' ', $qualifiers =~ /'(\w+)'/g), join(' ', $sfc =~ /"(\w+)"/g), 'docs/rung-file.md: the qualifiers');
my %default;
for my $entry (@$words) {
	$default{"$entry->{word}.$_->{pin}"} = $_->{default} for @{$entry->{pins} // []};
}
fact('docs/blocks.md', qr/^\*\*DEBOUNCE\*\*.*?(\d+) ms/m, $default{'DEBOUNCE.T_ON'} =~ /(\d+)/);
fact('docs/blocks.md', qr/^\*\*FIFO\*\*.*?SIZE.*?1 to (\d+)/m, $default{'FIFO.SIZE'});
is($default{'FIFO.SIZE'}, constant('runtime/engine/scan/fb_store.c', 'ROOM'), 'FIFO: the most values');
fact('docs/blocks.md', qr/^\*\*SHIFT\*\* is a shift register of N bits, 1 to (\d+)\./m,
     (slurp('runtime/engine/scan/fb_store.c') =~ /fb_bound\(fb->N, (\d+)\)/)[0]);
fact('docs/blocks.md', qr/^\*\*AVERAGE\*\*.*? N \(1 to (\d+)\)/m, constant('runtime/engine/scan/fb_analog.c', 'SAMPLES'));
fact('docs/blocks.md', qr/\bN, (\d+) if not given/, $default{'PID.N'});
fact('docs/blocks.md', qr/\bMIN and MAX are (\d+ and \d+)/, "$default{'PID.MIN'} and $default{'PID.MAX'}");
my %system = map { $_->{word} => 1 } @$words;
for my $path (@documents) {
	my @unknown = grep { !$system{$_} } $text{$path} =~ /\b(SYS_[A-Z][A-Z0-9_]*[A-Z0-9])\b/g;
	is("@unknown", '', "$path: system names");
}

# The manual lists the parts of a page by their headings: each is there once.
for my $path (@documents) {
	my %times;
	$times{$_}++ for $text{$path} =~ /^## (.+)$/mg;
	my @twice = grep { $times{$_} > 1 } sort keys %times;
	is("@twice", '', "$path: each part has a heading of its own");
}

# ---- messages ----
my %message = slurp('runtime/engine/diag.def') =~ /^DIAG\(\w+,\s*"(LD\d+)",\s*\w+,\s*"((?:[^"\\]|\\.)*)"\)/mg;
for my $path (@documents) {
	is(join(' ', grep { !defined $message{$_} } $text{$path} =~ /\b(LD\d{3})\b/g), '', "$path: codes of messages");
	while ($prose{$path} =~ /`(LD\d{3}): ([^`\n]+)`/g) {
		my ($code, $said) = ($1, $2);
		my ($begin) = $message{$code} =~ /^([^%{"\\]*)/;
		is(substr($said, 0, length $begin), $begin, "$path: the text of $code");
	}
}

# ---- tables of words ----
# The first column of the table under a line, as words in `…`.
sub column_of {
	my ($path, $heading, $column) = @_;
	my ($table) = $text{$path} =~ /^\Q$heading\E.*\n\|[-|]+\n((?:\|.*\n)+)/m;
	return [] if !defined $table;
	return [map { (split /\s*\|\s*/)[$column // 1] } split /\n/, $table];
}
my $catalog = slurp('runtime/engine/catalog.def');
my @types = $catalog =~ /^(?:TEXT_)?TYPE\((\w+),/mg;
list_is('docs/rung-file.md: the types', [map { s/\[n\]//r } map { /`([^`]+)`/g } @{column_of('docs/rung-file.md', '| type | holds |')}],
	[@types, 'TOD', 'DT']);
my ($signed, $unsigned) = ($text{'docs/rung-file.md'} =~ /^\| `SINT` [^|]*\| (.*?) \(/m, $text{'docs/rung-file.md'} =~ /^\| `USINT` [^|]*\| (.*?) \|/m);
is("$signed", join(', ', '−128…127', map { '±' . ((1 << ($_ - 1)) - 1) } 16, 32, 64), 'docs/rung-file.md: the range of SINT to LINT');
is("$unsigned", join(', ', map { '0…' . ($_ == 64 ? ~0 : (1 << $_) - 1) } 8, 16, 32, 64), 'docs/rung-file.md: the range of USINT to ULINT');
fact('docs/rung-file.md', qr/n from 1 to (\d+); without/, constant('runtime/engine/base/iec.h', 'IEC_STRING_MOST'));
fact('docs/rung-file.md', qr/without `\[n\]`: (\d+) \|/, constant('runtime/engine/base/iec.h', 'IEC_STRING_DEFAULT'));
fact('docs/rung-file.md', qr/`PRIORITY := 0…(\d+)`/, constant('runtime/engine/text/read_sfc.c', 'PRIORITY_MOST'));

my %modifiers = $catalog =~ /^OP\((\w+),\s*\w+,\s*([^"]*?),\s*"/mg;
my (%listed, @functions);
for (split /\n/, ($text{'docs/rung-file.md'} =~ /^\| operator \| modifiers .*\n\|[-|]+\n((?:\|.*\n)+)/m)[0]) {
	my (undef, $operators, $modifiers) = split /\|/;
	for my $operator ($operators =~ /`([A-Z]+)`/g) {
		$listed{$operator} = 1;
		if (!defined $modifiers{$operator}) {
			push @functions, $operator;
			next;
		}
		my $want = join ' ', $modifiers{$operator} =~ /MOD_C/ ? ('C', 'CN') : $modifiers{$operator} =~ /MOD_N/ ? 'N' : (),
			$modifiers{$operator} =~ /MOD_PAREN/ ? '(' : ();
		is(join(' ', split ' ', $modifiers), $want, "docs/rung-file.md: the modifiers of $operator");
	}
}
is(join(' ', grep { !$listed{$_} } keys %modifiers), '', 'docs/rung-file.md: the operators of lists');
is(join(' ', grep { !$system{$_} } @functions), '', 'docs/rung-file.md: functions as operators of lists');

my @elements = map { /`(?:(\[.*?\])|(---|\w+))/ ? $1 // $2 : () } map { split m{ / } }
	@{column_of('docs/language.md', '| element | drawn |')}, @{column_of('docs/language.md', '| coil | drawn |')};
list_is('docs/language.md: the elements', [map { /^\[.*:=/ ? '[:=]' : /^\[/ ? '[ ]' : $_ } @elements],
	[grep { !/^(?:---|\.|)$/ } $catalog =~ /^ELEM\(\w+,\s*"([^"]*)"/mg]);
my %picture = map { $_->{word} => $_->{picture} // '' } grep { $_->{kind} eq 'element' } @$words;
for my $row (map { split /\n/ } $text{'docs/language.md'} =~ /^\| (?:element|coil) \| drawn .*\n\|[-|]+\n((?:\|.*\n)+)/mg) {
	my (undef, $words_of, $drawn) = split /(?<!\/)\s*\|\s*/, $row;
	my @drawn = map { s/^([A-Z]+) .*/$1/r =~ s/^─|─$//gr } $drawn =~ /`([^`]+)`/g or next;
	my @of = $words_of =~ /`([A-Z]+)\b/g;
	is_deeply([grep { index($picture{$of[$_]} // '', $drawn[$_]) < 0 } 0 .. $#drawn], [], "docs/language.md: the drawing of @of");
}
my @times = map { /`(\w+)`/g } @{column_of('docs/language.md', '| written | is |', 2)};
ok(@times > 8 && !grep({ !$system{$_} } @times), 'docs/language.md: the functions of times');

list_is('docs/sfc.md: the qualifiers', [map { /`(\w+)`/ } @{column_of('docs/sfc.md', '| qualifier | calls')}], [$sfc =~ /"(\w+)"/g]);

my ($uses) = slurp('runtime/engine/xref/xref_print.c') =~ /kind_words\[.*?\] = \{(.*?)\}/s;
list_is('docs/symbols.md: the uses', [map { split /, / } @{column_of('docs/symbols.md', '| use | means')}],
	[$uses =~ /"([^"]+)"/g, 'unknown']);

# The grammar: its words are those that the reader looks for.
my ($grammar) = $text{'docs/rung-file.md'} =~ /^## Grammar\n.*?^```\n(.*?)^```/ms;
$grammar =~ s/\(\* .*? \*\)//g;
my %literal = map { $_ => 1 } $grammar =~ /'([A-Z_]+)'/g;
my $reader = join '', map { slurp($_) } glob 'runtime/engine/text/*.c runtime/engine/model/*.c';
my ($ends) = $reader =~ /bool read_ends_block.*?\{(.*?)\}/s;
my %read = map { $_ => 1 } $reader =~ /\b(?:lex_is|\w*accept\w*|\w*expect\w*|\w*peek\w*)\([^,()]*, "([A-Z][A-Z_]+)"\)/g,
	$ends =~ /"([A-Z_]+)"/g, grep { /^[A-Z]+$/ } $catalog =~ /^ELEM\(\w+,\s*"([^"]*)"/mg;
$read{$_} = 1 for slurp('runtime/engine/properties.def') =~ /^PROPERTY\((\w+)/mg;
delete @read{qw(AND AND_THEN OR OR_ELSE XOR MOD TRUE FALSE NULL REF ADR)}; # of expressions and constants
is(join(' ', sort grep { !$literal{$_} } keys %read), '', 'docs/rung-file.md: the grammar has the words of the reader');
is(join(' ', sort grep { !$read{$_} && $reader !~ /"\Q$_\E"/ } keys %literal), '', 'docs/rung-file.md: the reader has the words of the grammar');
my %defined = map { $_ => 1 } $grammar =~ /^([a-z][a-z-]*) +=/mg;
my $used = $grammar =~ s/'[^']*'//gr;
my %plain = map { $_ => 1 } qw(name integer number letters time constant address variable label pin member instance function
	function-block index operator expression qualifier text end of line an elementary type a structure function block);
is(join(' ', sort grep { !$defined{$_} && !$plain{$_} } map { /([a-z][a-z-]+)/g } $used), '', 'docs/rung-file.md: the grammar defines its terms');

# ---- ClassicLadder ----
my $classic = slurp('runtime/engine/classic.def');
my %bits = (1 => 'X', 32 => 'D');
my ($address_table) = $text{'docs/from-classicladder.md'} =~ /^\| ClassicLadder \| name without a symbol .*\n\|[-|]+\n((?:\|.*\n)+)/m;
my $memories = 0;
for my $row (split /\n/, $address_table) {
	my (undef, $old, $new, $where) = split /\s*\|\s*/, $row;
	my @new = $new =~ /`([^`]+)`/g;
	my @where = ($where // '') =~ /`([^`]+)`/g;
	@where = @new if $where && $where eq 'the same';
	for my $index (0 .. ($old =~ tr/%//) - 1) {
		my ($prefix, $number) = ($old =~ /`%([A-Z]+)(\d+)`/g)[2 * $index, 2 * $index + 1];
		next if !defined $prefix;
		my ($area, $first, $size, $name) = $classic =~ /^CLASSIC_MEMORY\(\d+,\s*"$prefix",\s*"(\w+)",\s*(\d+),\s*(\d+),\s*(?:"(\w+)"|NULL)\)/m or next;
		my $bit = $first + $number * $size;
		my $at = "%$area$bits{$size}" . int($bit / 8) . ($size == 1 ? '.' . $bit % 8 : '');
		is("$new[$index] $where[$index]", (defined $name ? "$name$number" : $at) . " $at", "docs/from-classicladder.md: %$prefix$number");
		$memories++;
	}
}
is($memories, () = $classic =~ /^CLASSIC_MEMORY\(\d/mg, 'docs/from-classicladder.md: every memory of ClassicLadder');
fact('docs/from-classicladder.md', qr/as are more than (\d+) that call one another/, limit('CALLS') - 2);
fact('docs/blocks.md', qr/0 to (\d+) and round; D: V is P/, constant('runtime/engine/scan/fb_classic.c', 'COUNT_MOST'));
fact('docs/blocks.md', qr/SIZE at most (\d+); LAST_OUT/, constant('runtime/engine/scan/fb_classic.c', 'REGISTER_ROOM'));
my @codes = map { /(LD\d+)/g } @{column_of('docs/from-classicladder-export.md', '| message |')};
list_is('docs/from-classicladder-export.md: the messages', \@codes, [grep { /^LD73/ } keys %message]);
my %cut = map { $_ => constant('runtime/engine/exchange/classic/classic_write.h', "CLASSIC_$_") }
	qw(SYMBOL SECTION_NAME COMMENT_LONG COMMENT SYMBOL_COMMENT);
is(join(' ', $text{'docs/from-classicladder-export.md'} =~ /names have (\d+) bytes, programs (\d+), titles (\d+) \(LinuxCNC (\d+)\), comments of symbols (\d+) \((\d+)\)/),
   join(' ', @cut{qw(SYMBOL SECTION_NAME COMMENT_LONG COMMENT COMMENT SYMBOL_COMMENT)}), 'docs/from-classicladder-export.md: lengths');
my ($columns, $rows) = slurp('runtime/engine/exchange/classic/classic_write.c') =~ /CLASSIC_COLUMNS : (\d+);.*?CLASSIC_ROWS : (\d+);/s;
fact('docs/from-classicladder-export.md', qr/\(rungs of (\d+) columns and \d+ rows\)/, $columns);
fact('docs/from-classicladder-export.md', qr/\(rungs of \d+ columns and (\d+) rows\)/, $rows);
fact('docs/from-classicladder-export.md', qr/symbols of at most (\d+) bytes/, $cut{SYMBOL});
my ($next_bit, $next_word) = slurp('runtime/engine/exchange/classic/to_classic_names.c') =~ /CLASSIC_UPSTREAM && e->next_bit < (\d+)\).*?CLASSIC_UPSTREAM && e->next_word < (\d+)\)/s;
fact('docs/from-classicladder-export.md', qr/from `%B(\d+)` and `%W\d+` on/, $next_bit);
fact('docs/from-classicladder-export.md', qr/from `%B\d+` and `%W(\d+)` on/, $next_word);

# ---- boards ----
my ($core_list) = $text{'docs/boards.md'} =~ /knows contacts, coils and jumps, all types, (.*?); an image/s;
my %core = map { $_ => 1 } grep { !/^REAL$/ } map { split ' ' } $core_list =~ /`([^`]+)`/g;
$core{$_} = 1 for qw(GT GE EQ LE LT NE); # "comparisons"
list_is('docs/boards.md: the words of WORDS=core', [keys %core], [$catalog =~ /^F[BN]\((\w+),/mg]);
my $push = slurp('runtime/ladder/cmd_push.c');
my ($sudoers) = $text{'docs/boards.md'} =~ /NOPASSWD: (.*?)\n\n/s;
list_is('docs/boards.md: the commands of ladder push that need root', [map { s/\s+$//r } $sudoers =~ m{/usr/bin/(systemctl [^,\\\n]+)}g],
	[$push =~ /\$root (systemctl .*? ladderd)/g]);
my ($order) = $text{'docs/boards.md'} =~ /restarted by the first of these that exists: (.*?)\. `--folder`/s;
my ($how) = $push =~ /^"if \[ -x \.\/service \](.*?)^"else/ms;
is(join(' ', map { s{/etc/ladder/}{./}r =~ s/^the //r } $order =~ m{(`/[^`]+`|the systemd unit|`ladderd-run`)}g) =~ tr/`//dr =~ s/ unit//r,
   join(' ', './service', map { /ladderd-run/ ? 'ladderd-run' : $_ } $how =~ /how=(systemd|\/\S+?|\$\(command -v ladderd-run\))(?:\\n|;)/mg),
   'docs/boards.md: what ladder push restarts');
for (qr/(retain: copy 12, .*?)[`;]/, qr/`(body: mean .*?)`/, qr/^    (period: .*)$/m, qr/^    task \w+: (on event.*)$/m, qr/^    task \w+: (every .*)$/m) {
	my ($shown) = $text{'docs/boards.md'} =~ $_;
	my $control = join ' ', slurp('runtime/ladderd/control.c') =~ /"((?:[^"\\]|\\.)*)"/g;
	$control =~ s/%\.?\d*(?:ll)?[uds](?:\.%lld us)?|\\n/ /g;
	my @unknown = grep { !/^us$/ && $control !~ /(?<!\w)\Q$_\E(?!\w)/ } ($shown // 'no line') =~ /([a-z][\w-]*(?: [a-z][\w-]*)*)/g;
	is("@unknown", '', 'docs/boards.md: a line of the status: ' . ($shown // $_));
}
my $period = constant('runtime/ladderd/cycle.c', 'PERIOD') / 1e6;
fact('docs/language.md', qr/Without `--period` (\d+) ms take its place/, $period);
like($help, qr/or ${period}ms\\n/, 'ladderd --help: the default of --period');
fact('docs/scenarios.md', qr/of the program, or (\d+) ms \|/, (slurp('runtime/engine/trial/scenario_read.c') =~ /(\d+) \* VALUE_MS/)[0]);
my ($quiet) = slurp('runtime/ladderd/store_thread.c') =~ /period_ns \/ (\d+);/;
is($quiet, 10, 'docs/boards.md: a tenth of --retain-period') if $text{'docs/boards.md'} =~ /\(a tenth of `--retain-period`/;
like(slurp('packaging/ladderd.default'), qr/--retain /, 'packaging/ladderd.default has --retain');

# ---- options, make targets, files ----
my @help = map { scalar `$ladder help $_` } split ' ', `$ladder help --names`;
my $usages = join "\n", @help, $help,
	map { slurp($_) } 'runtime/guard/main.c', 'runtime/modbus/main.c', 'editor-gtk/window/usage.c', 'editor-gtk/render/render.c';
my %foreign = map { $_ => 1 } qw(--system --reload --now --subsystem-match --write --print-architecture); # of other programs
for my $path (@documents) {
	my @unknown = grep { !$foreign{$_} && $usages !~ /\Q$_\E\b/ } $prose{$path} =~ /(?<![\w-])(--[a-z][a-z-]+)/g;
	is("@unknown", '', "$path: options");
}
my %target = map { $_ => 1 } slurp('Makefile') =~ /^([a-z][a-z-]*):/mg;
my %variable = map { $_ => 1 } slurp('Makefile') =~ /\$[({]([A-Z_]+)/g;
for my $path (@documents) {
	my @unknown = grep { !$target{$_} } $text{$path} =~ /(?:`|^ *)make(?: [A-Z_]+=[^\s`]+)* ([a-z][a-z-]*)(?=`| *#|\n|[ A-Z=]*`)/mg;
	is("@unknown", '', "$path: targets of make");
	@unknown = grep { !$variable{$_} } map { /([A-Z_]+)=/g } $text{$path} =~ /\bmake((?: [A-Z_]+=[^\s`]+)+)/g;
	is("@unknown", '', "$path: variables of make");
	my @gone;
	while ($text{$path} =~ m{`((?:packaging|ladders|tests|runtime|hal|editor-gtk|docs)/[\w./*-]*)`}g) {
		my @found = glob $1;
		push @gone, $1 if !@found || !-e $found[0];
	}
	is("@gone", '', "$path: files") if $path ne 'ARCHITECTURE.md';
}

# ---- lists ----
my @samples = map { basename($_, '.rung') } glob('ladders/*.rung'), map { dirname($_) } glob('ladders/*/main.st');
my @folders = grep { -e "ladders/$_/$_.rung" } map { basename($_) } glob('ladders/*');
list_is('README.md: the samples', [$text{'README.md'} =~ /^\| \[([\w-]+)\]\(ladders\//mg], [@folders, grep { !/\.plant$/ } @samples]);
my @plants = ((grep { -e "ladders/$_/$_.plant.rung" } @folders), map { s/\.plant$//r } grep { /\.plant$/ } @samples);
list_is('README.md: the samples with a plant', [$text{'README.md'} =~ /\(ladders\/(?:[\w-]+\/)?([\w-]+)\.plant\.rung\)/g], \@plants);
my ($with) = $text{'docs/scenarios.md'} =~ /^(`ladders\/garage-door\.rung`.*? come with one.*)$/m;
list_is('docs/scenarios.md: the samples with a plant', [$with =~ /`(?:ladders\/)?(?:[\w-]+\/)?([\w-]+)\.rung`/g], \@plants);
list_is('README.md: the documents', [$text{'README.md'} =~ /^\| \[(docs\/[\w-]+\.md)\]/mg],
	[grep { m{^docs/} && !m{/from-classicladder-export} } @documents]);
my $run = slurp('run');
my %package = map { $_ => 1 } map { split } $run =~ /^\w+_packages="(.*?)"$/msg;
for my $path (@documents) {
	is(join(' ', grep { !$package{$_} } map { split } $text{$path} =~ /apt-get install ([a-z0-9 +-]+)/g), '', "$path: packages");
	is(join(' ', grep { $run !~ /^\Q$_\E\)/m } $text{$path} =~ /\.\/run ([a-z]+)/g), '', "$path: ./run");
}
my %maps = map { $_ => 1 } $text{'docs/boards.md'} =~ /\b([\w-]+\.io)\b/g;
is(join(' ', grep { !$maps{$_} } map { basename($_) } glob 'ladders/boards/*.io'), '', 'docs/boards.md: every map of ladders/boards');
my $map_words = slurp('hal/map_words.def');
my ($map_table) = $text{'docs/boards.md'} =~ /^\| option \| for \|.*?\n(.*?)\n\n/ms;
my %map_option = map { $_ => 1 } map { s/=.*//r } map { split ' ' } map { /`([^`]+)`/g } map { (split /\|/)[1] } grep { !/^\|-/ } split /\n/, $map_table;
list_is('docs/boards.md: the options of a line', [keys %map_option], [$map_words =~ /^CHIP_OPTION\(\w+, "([a-z-]+)",/gm]);
for my $kind (qw(value bus)) {
	my ($table) = $text{'docs/field.md'} =~ /^\| option of a $kind \| for \|.*?\n(.*?)\n\n/ms;
	my %said = map { $_ => 1 } map { s/=.*//r } map { /`([^`]+)`/g } map { (split /\|/)[1] } grep { !/^\|-/ } split /\n/, $table;
	my $macro = uc $kind;
	my %row = map { $_ => 1 } $map_words =~ /^${macro}_OPTION\(\w+, "([a-z-]+)",/gm;
	list_is("docs/field.md: the options of a $kind", [keys %said], [keys %row]);
}
my ($takes_table) = $text{'docs/field.md'} =~ /^\| option of a device \|.*?\n(.*?)\n\n/ms;
list_is('docs/field.md: the options of a device', [map { s/=.*//r } map { /`([^`]+)`/g } map { (split /\|/)[1] } grep { !/^\|-/ } split /\n/, $takes_table],
	[$map_words =~ /^DEVICE_(?:OPTION|FLAG|ORDER)\(\w+, "([a-z-]+)",/gm]);
my ($modules) = $text{'docs/field.md'} =~ /^\| type \| digital inputs.*?\n(.*?)\n\n/ms;
is(join(' ', $modules =~ /^\| `(\w+)` \| (\d+) \| (\d+) \| (\d+) \|/mg),
	join(' ', slurp('hal/modules.def') =~ /^MODULE\((\w+), (\d+), (\d+), (\d+), 0\)/mg), 'docs/field.md: the modules');
my @drivers = slurp('hal/drivers.def') =~ /^DRIVER\((\w+)\)/mg;
my ($driver_list) = $text{'docs/boards.md'} =~ /^Drivers: (.*?)\n\n/ms;
is(join(' ', grep { $driver_list !~ /`\Q$_\E`/ } @drivers), '', 'docs/boards.md: the drivers');
my ($push_table) = $text{'docs/boards.md'} =~ /^\| exit status \| means \|\n\|---\|---\|\n(.*?)\n\n/ms;
is(join(' ', $push_table =~ /^\| (\d+) /mg), '0 1 2', 'docs/boards.md: the exit status of ladder push');

my %language = (de => 'German', fr => 'French', zh_CN => 'Chinese');
my @languages = split ' ', slurp('editor-gtk/po/LINGUAS');
list_is('the languages of the editor have names here', [keys %language], \@languages);
for my $path ('README.md', 'docs/editor.md', 'docs/languages.md') {
	my ($line) = $prose{$path} =~ /^(.*\bGerman\b.*)$/m;
	is(join(' ', grep { $line !~ /\b$language{$_}\b/ } @languages), '', "$path: the languages");
}

for my $path (glob 'packaging/*.desktop packaging/*.metainfo.xml packaging/rungboard.xml') {
	my $written = slurp($path);
	is(join(' ', grep { $written !~ /\[$_\]=|xml:lang="$_"/ } @languages), '', "$path: the languages");
}
my ($mime) = slurp('packaging/rungboard.xml') =~ /<mime-type type="([^"]+)"/;
like(slurp('packaging/org.rungboard.Editor.desktop'), qr/^MimeType=\Q$mime\E;$/m, 'the desktop file names the type of rung files');
my $keys = slurp('packaging/org.rungboard.Editor.gschema.xml');
my $editor = join '', map { slurp($_) } glob 'editor-gtk/*/*.c editor-gtk/*/*.h';
is(join(' ', grep { $editor !~ /"\Q$_\E"/ } $keys =~ /<key name="([a-z-]+)"/g), '', 'the editor uses every setting of the schema');

# Each line of the page "What happens when" is run by a test (tests/happens.txt).
my ($happens) = $text{'docs/boards.md'} =~ /^## What happens when\n(.*?)^## /ms;
my @told = map { /^\| (.*?) \|/ } grep { !/^\|[-|]+\|$/ && !/^\| (?:what happens|when) \|/ } split /\n/, $happens;
my @run = map { [split / \| /] } grep { /^[^#]/ } split /\n/, slurp('tests/happens.txt', ':encoding(UTF-8)');
my %is_run = map { $_->[0] => 1 } @run;
cmp_ok(scalar @told, '>', 30, 'docs/boards.md: lines of "What happens when"');
list_is('tests/happens.txt: the lines of docs/boards.md, "What happens when"', [keys %is_run], \@told);
for my $line (@run) {
	my ($what, $path, $test) = @$line;
	ok(defined $test && index(slurp($path, ':encoding(UTF-8)') // '', $test) >= 0, "tests/happens.txt: $what: $path has its test")
		or diag("not there: " . ($test // 'no text'));
}

# What a board must do that one can leave alone is shown by tests (tests/bars.txt).
my @bars = map { [split / \| /] } grep { /^\d/ } split /\n/, slurp('tests/bars.txt', ':encoding(UTF-8)');
is_deeply([sort { $a <=> $b } keys %{{ map { $_->[0] =~ /^(\d+) / => 1 } @bars }}], [3 .. 13, 15, 22 .. 26, 39], 'tests/bars.txt: all numbers');
for my $bar (@bars) {
	my ($what, $path, $test) = @$bar;
	ok(defined $test && index(slurp($path, ':encoding(UTF-8)') // '', $test) >= 0, "tests/bars.txt: $what: $path has its test")
		or diag("not there: " . ($test // 'no text'));
}

# Each kind of event is made by a test, and the board is killed after it.
list_is('tests/online/link.py, KINDS: the rows of events.def', [(slurp('tests/online/link.py') =~ /^KINDS = \{\n(.*?)^\}/ms)[0] =~ /'([A-Z_]+)': \(/g],
	[slurp('runtime/online/events.def') =~ /^EVENT\((\w+),/mg]);

my @vehicles = grep { $_ ne 'sizes' } map { basename($_) } grep { -f && -x } glob 'tests/targets/*';
list_is('Makefile: the vehicles', [split ' ', (slurp('Makefile') =~ /^VEHICLES +\?= (.*)$/m)[0]], \@vehicles);
list_is('./run help: the vehicles', [split ' ', ($run =~ /in emulators:\n\s+(.*?);/)[0]], \@vehicles);

my ($live_keys) = slurp('runtime/ladder/live.c') =~ /keys\[\] = "(\w+)"/;
is($live_keys, join('', 1 .. 9, grep { !/[sq]/ } 'a' .. 'z'), 'ladder run --help: the keys of inputs');

my $render = slurp('editor-gtk/render/render.c');
my ($render_help) = $render =~ /"  --pou NAME(.*?)^}/ms;
my %render_option = map { $_ => 1 } '--pou', '--help', $render_help =~ /(--[a-z-]+)/g;
my ($picture_table) = $text{'docs/pictures.md'} =~ /^\| option \| \|\n\|---\|---\|\n(.*?)\n\n/ms;
my %picture_option = map { $_ => 1 } map { /`(--[a-z-]+)/g } map { (split /\|/)[1] } split /\n/, $picture_table;
list_is('docs/pictures.md: the options', [keys %picture_option], [keys %render_option]);
fact('docs/pictures.md', qr/^\| `--scale S` \| ([\d.]+ to \d+);/m, ($render =~ /--scale S +([\d.]+ to \d+);/)[0]);
fact('docs/pictures.md', qr/^\| `--paper SIZE` \| of a PDF: (.*) \|$/m,
     join ', ', map { $_ eq 'a4' ? '`a4` (default)' : "`$_`" } split /, /, ($render =~ /of a PDF: ([a-z0-9, ]+)\\n/)[0]);

# ---- the editor ----
# Labels in the documents are texts of the editor, or keys, or a heading of a report.
my $texts = slurp('editor-gtk/po/de.po', ':encoding(UTF-8)') =~ s/"\n"//gr;
my %label = map { $_ => 1 } map { s/_|\\n.*//gr } $texts =~ /^msgid "((?:[^"\\]|\\.)*)"/mg;
for my $path (grep { $_ ne 'ARCHITECTURE.md' } @documents) {
	my @unknown = grep { !$label{$_} && !$label{"$_…"} && !/^(?:F\d|Lost)$/ }
		$prose{$path} =~ /(?<![*\w\\])\*([A-Z][^*\n]{1,60})\*(?![*\w])/g;
	is(join('; ', @unknown), '', "$path: labels of the editor");
}
# Keys with a letter or a function key; arrows, Enter and others have no row of their own.
SKIP: {
	skip 'there is no ladder-editor', scalar @documents if !-x "$build/ladder-editor";
	local $ENV{LC_ALL} = 'C.UTF-8';
	my %key = map { join('+', sort split /\+/) => 1 } map { split /, / }
		join("\n", map { scalar `$build/ladder-editor --keys '$_'` } 'rungboard', 'micro/win', 'gx works', 'ldmicro') =~ /^  (\S.*?)  /mg;
	for my $path (@documents) {
		my @unknown = grep { !$key{join '+', sort split /\+/} && $_ ne 'F10' } # GTK opens the menu
			$prose{$path} =~ /`((?:(?:Ctrl|Shift|Alt)\+)*(?:F\d+|(?<=\+)[A-Z;.,\/]))`/g;
		is("@unknown", '', "$path: keys of the editor");
	}
}

# F1: each panel and each page of a tab has a page of the manual.
my %help = map { $_ => 1 } slurp('editor-gtk/window/help_places.def') =~ /^PLACE\("([^"]+)"/mg;
my $window = join '', map { slurp($_) } glob 'editor-gtk/window/*.c';
my @helped = ((map { "below $_" } $window =~ /below_add\([^;"]*"(\w+)", N_\(/g),
	      map { "page $_" } slurp('editor-gtk/window/tabs.c') =~ /strcmp\(name, "(\w+)"\) == 0\)\n\t\tpage = /g);
cmp_ok(scalar @helped, '>', 10, 'panels and pages are found');
is(join(' ', grep { !$help{$_} } @helped), '', 'help_places.def: a row for each panel and page');

# ---- words of scenarios and scripts ----
my $scenarios = slurp('runtime/engine/trial/scenario_read.c');
my ($lines) = $text{'docs/scenarios.md'} =~ /^\| line \| means \|\n\|---\|---\|\n(.*?)\n\n/ms;
my %said = map { $_ => 1 } $lines =~ /^\| `([a-z]+)/mg;
is(join(' ', grep { !$said{$_} } grep { /^[a-z]+$/ } $scenarios =~ /accept\(reader, "(\w+)"\)/g), '', 'docs/scenarios.md: the words of a scenario');
my $script = slurp('runtime/engine/trial/script.c');
my ($script_table) = $text{'docs/scenarios.md'} =~ /^\| in a line \| means \|\n\|---\|---\|\n(.*?)\n\n/ms;
is(join(' ', grep { $script_table !~ /`\Q$_\E\b/ } $script =~ /is_word\(\w+, "(\@?[a-z]+)"\)/g), '', 'docs/scenarios.md: the words of a script');

# ---- the help of commands ----
my $rows_of_commands = slurp('runtime/ladder/commands.def');
my $commands = join '', map { slurp($_) } glob 'runtime/ladder/*.c';
is(join(' ', grep { $commands !~ /"\Q$_\E"/ } $rows_of_commands =~ /\{ "(--?[a-z-]+)",/g), '', 'runtime/ladder/commands.def: the options are looked for');
for my $help (grep { /--period/ && !/^ladder board:/m } @help) { # there it is no time between scans
	my ($command) = $help =~ /^ladder (\w+):/m;
	my ($default) = $help =~ /or\s+(\d+)ms/;
	is($default, $_, "ladder $command --help: the default of --period") for $commands =~ /(?:tasks_tick|period).*? (\d+) \* VALUE_MS/g;
}
my ($scans) = slurp('runtime/ladder/cmd_bench.c') =~ /report_count\(call, "--scans", (\d+),/;
like($rows_of_commands, qr/"scans of each kind, default $scans"/, 'ladder bench --help: the default of --scans');
my ($of_trace) = grep { /^ladder trace:/m } @help;
is(join(' ', grep { $of_trace !~ /(?<![\w@])\Q$_\E\b/ } $script =~ /is_word\(\w+, "(\@?[a-z]+)"\)/g), '', 'ladder trace --help: the words of a script');

# ---- ARCHITECTURE.md ----
my ($rooms) = slurp('tests/floors.sh') =~ /^rooms="\n(.*?)^"/ms;
my @rooms = map { m{([\w-]+)$} ? "$1/" : () } map { (split ' ')[0] } split /\n/, $rooms;
is(join(' ', grep { index($text{'ARCHITECTURE.md'}, $_) < 0 } @rooms), '', 'ARCHITECTURE.md: every room of tests/floors.sh');
my @allowed = map { m{^(?:engine|hal|editor-gtk)(?:/|$)} ? $_ : () } map { split } slurp('tests/floors.sh') =~ /^(?:rooms|doors|sheets)=["'](.*?)["']$/msg;
is(join(' ', grep { !-e && !-e "runtime/$_" } @allowed), '', 'tests/floors.sh: the table names what is there');
# A room includes only rooms behind it in the chains of ARCHITECTURE.md.
my ($setup) = slurp('tests/floors.sh') =~ /\A(.*?)^# Libraries/ms;
my (undef, $listing) = answer('.', 'sh', '-c', "$setup\nprintf '%s\\n' \"\$rooms\"");
my @upwards;
for my $home ('editor-gtk', 'engine') {
	my ($level, %level) = (0);
	my $floor = $home =~ s/-gtk//r;
	for my $group (split /→/, ($text{'ARCHITECTURE.md'} =~ /^\| $floor \| ([^|]+)/m)[0]) {
		$level++;
		$level{"$home/$_"} = $level for map { s{/$}{}r } map { split } $group =~ /`([^`]+)`/g;
	}
	for (grep { /\S/ } split /\n/, $listing) {
		my ($room, @below) = map { s{^runtime/}{}r =~ s{/classic$}{}r } split;
		push @upwards, map { "$room -> $_" } grep { defined $level{$_} && defined $level{$room} && $_ ne $room && $level{$_} <= $level{$room} } @below;
	}
	cmp_ok(scalar keys %level, '>', 8, "ARCHITECTURE.md: the rooms of $home/");
}
for (['the doors of the engine', $setup =~ /^doors='([^']+)'/m, qr/the engine's doors: (.*?) \|/],
     ['what hal/ may include', $setup =~ /^hal +(.*)$/m, qr/^\| hal \| `hal\/` \| (.*?) \|/m]) {
	my ($what, $allowed, $pattern) = @$_;
	list_is("ARCHITECTURE.md: $what", [map { s{/$}{}r } map { split } ($text{'ARCHITECTURE.md'} =~ $pattern)[0] =~ /`([^`]+)`/g],
		[map { s{^engine/}{}r } split ' ', $allowed]);
}
is("@upwards", '', 'ARCHITECTURE.md: the order of rooms is that of tests/floors.sh');
my %hundred = map { /LD(\d)/; $1 => 1 } keys %message;
my ($ranges) = $text{'ARCHITECTURE.md'} =~ /(LD0xx system.*?)\n\n/s;
list_is('ARCHITECTURE.md: the ranges of codes', [map { /^LD(\d)/ ? $1 : /^(\d)xx/ } split /, /, $ranges =~ s/\n\s*/ /gr], [keys %hundred]);
like($text{'ARCHITECTURE.md'}, qr/those of a scenario are evaluated between scans by/, 'ARCHITECTURE.md: expressions of a scenario');
like(slurp('runtime/engine/trial/scenario.c'), qr/\bformula_value\(/, 'trial/scenario.c evaluates them');

# ---- versions ----
my ($version) = slurp('runtime/engine/base/version.h') =~ /LADDER_VERSION "([\d.]+)"/;
my @releases = slurp('packaging/org.rungboard.Editor.metainfo.xml') =~ /<release version="([\d.]+)"/g;
is($releases[0], $version, 'the newest release of the metainfo is this version');
fact('docs/editor.md', qr/if GTK (\d+) is installed/, (slurp('Makefile') =~ /^EDITOR_NEEDS := gtk(\d+)/m)[0]);

done_testing();
