#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# il_again.t - the output of `ladder il` is a program that behaves the same: each sample
# with its scenarios, and random programs with random inputs.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Copy qw(copy);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $random = "$build/tests/bin/differential";
my $count = $ENV{IL_AGAIN_COUNT} // 300;
my $dir = tempdir(CLEANUP => 1);

# Samples. Included files are lists, too, in the same file.
for my $sample (sort glob "$tests/../ladders/*.rung") {
	my $name = basename($sample);
	my $again = "$dir/$name";
	# The list of a chart has TICK and EACH, which no rung file can contain.
	next if slurp($sample) =~ /^PROGRAM \w+ SFC/m;
	spew($again, scalar `$ladder il '$sample' 2>/dev/null`);
	my $said = `$ladder check '$again' 2>&1`;
	unlike($said, qr/ error LD/, "$name: its list is a program") or next;
	is(scalar `$ladder il '$again' 2>/dev/null`, slurp($again),
	   "$name: the list of its list is the same");
	(my $scenario = $sample) =~ s/rung$/scn/;
	next unless -e $scenario;
	copy($scenario, "$dir/" . basename($scenario));
	my $tap = `$ladder test '$again' 2>&1`;
	ok($? == 0 && $tap =~ /^ok/m, "$name: its scenarios hold") or diag($tap);
}

# Golden cases of Structured Text and of blocks, with the variables that their stimulus prints.
for my $case (qw(st-case-labels st-splits st-calls st-main-none st-stored-values st-at-copies st-jumps
		st-at-everywhere any-bounds-everywhere edges-of-inputs word-bytes-and-letters)) {
	my $from = "$tests/golden/$case";
	spew("$dir/case.rung", scalar `$ladder il '$from/main.rung' 2>/dev/null`);
	is(scalar `cd $dir && $ladder trace case.rung '$from/stimulus' 2>/dev/null`, slurp("$from/expected.trace"),
	   "$case: its lists do the same");
}

# Programs of the documents, which have pointers, references, unions, actions and calls of programs. A pointer itself
# is another number where temporaries change the layout.
my ($shown, @differ) = (0);
for my $page (map { "$tests/../docs/$_.md" } qw(st declarations language rung-file)) {
	my $text = slurp($page);

	while ($text =~ /^```rung (\S+)\n(.*?)^```/msg) {
		my ($name, $program) = ($1, $2);
		my ($end) = $name =~ /(\w+)$/;
		next if $program =~ /\bSFC\b|INITIAL_STEP/ || $program =~ /^CONFIGURATION/m;
		spew("$dir/shown.$end", $program);
		`$ladder check $dir/shown.$end 2>&1`;
		next if $?;
		my $list = `$ladder il $dir/shown.$end 2>/dev/null`;
		my $as = $list =~ /^RUNGBOARD/ ? 'rung' : $end;
		spew("$dir/list.$as", $list);
		my @lines = map { scalar `printf '.\n.\n.\n' | $ladder trace $dir/$_ - 2>/dev/null` } "shown.$end", "list.$as";
		my @values = map { [map { {/(\S+?)=('(?:[^'\$]|\$.)*'|\S*)/g} } split /\n/] } @lines;
		$shown++;
		for my $i (0 .. $#{$values[0]}) {
			my ($want, $is) = ($values[0][$i], $values[1][$i] // {});
			push @differ, map { "$name: $_ is " . ($is->{$_} // 'not there') . ", not $want->{$_}" }
				grep { $want->{$_} !~ /^\d{15,}$/ && ($is->{$_} // '') ne $want->{$_} } sort keys %$want;
		}
	}
}
cmp_ok($shown, '>', 60, 'programs of the documents became lists');
is(join("\n", @differ), '', 'which do the same');

# Random programs. Only names of both programs are compared, so temporaries do not count.
sub names_of {
	my ($text) = @_;
	my %seen;
	my @block = $text =~ /^VAR\n(.*?)^END_VAR/msg;
	$seen{$1} = 1 while ($block[0] // '') =~ /^\s*(\w+)[^:\n]*:\s*(?:BOOL|S?INT|DINT|U(?:S|D)?INT|BYTE|D?WORD|TIME|REAL);/mg;
	return sort keys %seen;
}

sub stimulus {
	my ($seed, @names) = @_;
	my $text = '@print ' . join(' ', @names, '%QB0', '%QB1', '%MB0', '%MB1',
				    'SYS_ERRORS') . "\n";
	srand $seed;
	for (1 .. 12) {
		$text .= join ' ', map { sprintf '%%IX%d.%d=%d', rand 8, rand 8, rand 2 }
			1 .. 4;
		$text .= "\n";
	}
	return $text;
}

my ($same, $other) = (0, 0);
my @bad;
for my $seed (1 .. $count) {
	my $program = `$random --seed $seed --text`;
	spew("$dir/a.rung", $program);
	my $list = `$ladder il $dir/a.rung 2>/dev/null`;
	next unless $? == 0;
	spew("$dir/b.rung", $list);
	spew("$dir/s", stimulus($seed, names_of($program)));
	my $one = `cd $dir && $ladder trace a.rung s 2>/dev/null`;
	my $two = `cd $dir && $ladder trace b.rung s 2>/dev/null`;
	# A rung of the first program is a line of the other one.
	s/^# STOP.*\n//mg for $one, $two;
	if ($one eq $two && $one =~ /^1 t=/) {
		$same++;
	} else {
		$other++;
		push @bad, "seed $seed";
	}
}
is($other, 0, "$same random programs and their lists do the same") or
	diag("not so: @bad");
ok($same * 10 > $count * 9, 'few random programs are refused');
# Code images: their lists do the same.
sub lists_of {
	my ($from, $to) = @_;
	my $said = `cd $dir && $ladder build $from -o image.code 2>&1`;
	return "build: $said" if $?;
	$said = `cd $dir && $ladder il image.code 2>&1 >$to`;
	return $? ? "il: $said" : '';
}

# An image does not know the names of values: `Phase : (Empty, Go := 5)` of a text.
sub values_of {
	my ($text) = @_;
	my %number;
	while ($text =~ /^  \w+ : (?:\w+ )?\((\w[\w, :=]*)\)/mg) {
		my $next = 0;
		for (split /, /, $1) {
			my ($name, $is) = split / := /;
			$next = $is if defined $is;
			$number{$name} = $next++;
		}
	}
	return %number;
}

for my $sample (sort glob "$tests/../ladders/*.rung") {
	my $name = basename($sample);
	next if $name =~ /plant/;
	is(lists_of($sample, "image-$name"), '', "$name: its image has lists") or next;
	(my $scenario = $sample) =~ s/rung$/scn/;
	next unless -e $scenario;
	# Members have _ for a dot, and so has the scenario then.
	my $list = slurp("$dir/image-$name");
	my $text = slurp($scenario);
	my %flat = map { $_ => 1 } $list =~ /^  (\w+_\w+) /mg;
	$text =~ s/\b(\w+)\.(\w+)\b/$flat{"$1_$2"} ? "$1_$2" : "$1.$2"/ge;
	my %value = values_of(slurp($sample));
	$text =~ s/^\s*scenario.*(*SKIP)(*FAIL)|'[^']*'(*SKIP)(*FAIL)|\b(?:\w+#)?(\w+)\b/$value{$1} \/\/ $&/gme if %value;
	copy($_, "$dir/" . basename($_)) for glob "$tests/../ladders/*.plant.rung";
	spew("$dir/image-" . basename($scenario), $text);
	(my $plant = $name) =~ s/rung$/plant.rung/;
	copy("$dir/$plant", "$dir/image-$plant") if -e "$dir/$plant";
	my $tap = `cd $dir && $ladder test image-$name 2>&1`;
	ok($? == 0 && $tap =~ /^ok/m, "$name: the scenarios hold for the lists of its image") or
		diag($tap);
}

($same, $other, @bad) = (0, 0);
for my $seed (1 .. $count) {
	my $program = `$random --seed $seed --text`;
	spew("$dir/a.rung", $program);
	my $said = lists_of('a.rung', 'b.rung');
	next if $said =~ /^build/;
	my $list = slurp("$dir/b.rung");
	spew("$dir/s", stimulus($seed, grep { $list =~ /^  \Q$_\E /m } names_of($program)));
	my $one = `cd $dir && $ladder trace a.rung s 2>/dev/null`;
	my $two = `cd $dir && $ladder trace b.rung s 2>/dev/null`;
	s/^# STOP.*\n//mg for $one, $two;
	if ($said eq '' && $one eq $two && $one =~ /^1 t=/) {
		$same++;
	} else {
		$other++;
		push @bad, "seed $seed $said";
	}
}
is($other, 0, "$same random programs and the lists of their images do the same") or
	diag("not so: @bad");
ok($same * 10 > $count * 9, 'few random programs are refused');

# Names that the lists make beside those of the image: each of them is there already.
spew("$dir/a.rung", <<'END');
RUNGBOARD 1

CONFIGURATION Image
VAR_GLOBAL
  Table : ARRAY[1..40] OF INT;
  Index : INT := 3;
  Out   : INT;
  Index_of_image_INT : INT;
  Initial_MB10 AT %MB10 : BYTE := 16#07;
  Wide AT %MW12 : INT := 700;
  MW12_INT : INT := 5;
  Twice AT %QX1.0 : BOOL;
  Mix : Recipe;
  Only : INT;
END_VAR
TASK Task0 (INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM Run0 WITH Task0 : Main;
VAR_ACCESS
  Fill  : Out : INT READ_WRITE;
  Other : Only : INT READ_WRITE;
  Mixed : Mix : Recipe READ_WRITE;
END_VAR
END_CONFIGURATION

TYPE
  Recipe : STRUCT
    Speed : INT;
    Level : INT;
  END_STRUCT;
END_TYPE

PROGRAM Main LD
VAR
  N0 : BOOL;
  Zero_of_image : INT := 1;
END_VAR
RUNG
  | NO N0 | [ Out := Table[Index] + Wide + MW12_INT ] | [ Table[Index] := Zero_of_image ] | COIL %QX0.1 |
RUNG
  | NO N0 | [ Index := Index + 1 ] | [ Mix.Speed := Out + Index_of_image_INT ] | COIL Twice |
RUNG
  | NO %IX0.0 | COIL N0 |
END_PROGRAM
END
is(lists_of('a.rung', 'b.rung'), "il: VAR_ACCESS: an access as it was named; it is now Mixed_Speed\n" .
	"VAR_ACCESS: an access as it was named; it is now Mixed_Level\n",
   'an access by a name with a point is told');
is(lists_of('b.rung', 'c.rung'), '', 'the lists of an image have an image and lists');
is(lists_of('c.rung', 'd.rung'), '', 'and these, too');
spew("$dir/s", '@print %QB0 %QB1 %MB10 %MW12 SYS_ERRORS' . "\n" . "%IX0.0=1\n" x 60);
my $first = `cd $dir && $ladder trace a.rung s 2>/dev/null`;
like($first, qr/SYS_ERRORS=[1-9]/, 'an index goes beyond its array');
is(scalar `cd $dir && $ladder trace $_.rung s 2>/dev/null`, $first, "$_ does the same")
	for qw(b c d);

# Without names there are still places.
spew("$dir/a.rung", slurp("$tests/../ladders/garage-door.rung"));
system("cd $dir && $ladder build --small a.rung -o image.code >/dev/null 2>&1") == 0 or die;
is(system("cd $dir && $ladder il image.code >b.rung"), 0, 'a small image has lists');
my $stimulus = '@print %QB0 SYS_ERRORS' . "\n" .
	join('', map { sprintf "%%IX0.0=%d %%IX0.1=%d %%IX0.2=%d\n", $_ & 1, $_ >> 1 & 1, $_ >> 2 & 1 } 1 .. 20);
spew("$dir/s", $stimulus);
is(scalar `cd $dir && $ladder trace b.rung s 2>/dev/null`,
   scalar `cd $dir && $ladder trace a.rung s 2>/dev/null`, 'they do the same');
done_testing;
