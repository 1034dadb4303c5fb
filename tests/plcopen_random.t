#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen_random.t - random ladders and function block diagrams in PLCopen XML: what an evaluator
# here, which knows nothing of the import, makes of the graph, and what `ladder trace` does with the
# file. The same projects are exported, imported again and run: they must do the same.
#
# The evaluator: what acts are outputs, coils and blocks; first those with an executionOrderId, by
# number, then outputs from top to bottom and from left to right, then blocks that nothing needed.
# Each takes what it needs along the connections; a block is called once in a scan.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $tests = dirname(abs_path(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
my $projects = $ENV{PROJECTS} // 60; # of each language; more by hand
my $scans = 12;
chdir $folder or die;

sub spew { my ($name, $text) = @_; open my $out, '>', $name or die; print $out $text; close $out or die }
spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
plan skip_all => 'built without libxml2' if `$ladder check probe.xml 2>&1` =~ /LD040/;

# The same numbers on every machine.
my $seed;
sub dice { my ($n) = @_; $seed = ($seed * 1103515245 + 12345) & 0x7fffffff; return int(($seed >> 8) % $n) }
sub one_of { return $_[dice(scalar @_)] }

my @inputs = map { "I$_" . 'n' } 0 .. 5; # nobody writes these
my @bits = map { "B$_" . 't' } 0 .. 7;
my %pins = (
	AND => [[qw(IN1 IN2)], ['OUT']], OR => [[qw(IN1 IN2)], ['OUT']], XOR => [[qw(IN1 IN2)], ['OUT']],
	NOT => [['IN'], ['OUT']], SEL => [[qw(G IN0 IN1)], ['OUT']],
	R_TRIG => [['CLK'], ['Q']], F_TRIG => [['CLK'], ['Q']], SR => [[qw(S1 R)], ['Q1']], RS => [[qw(S R1)], ['Q1']],
);
my @blocks = qw(R_TRIG F_TRIG SR RS);

# ---- a random project ----
my ($elements, $id, %instances);
sub connection { my ($from, $pin) = @_; return "<connection refLocalId=\"$from\"" . ($pin ? " formalParameter=\"$pin\"" : '') . '/>' }
sub point { return '<connectionPointIn>' . join('', map { connection(@$_) } @_) . '</connectionPointIn>' }
sub position { my ($x, $y) = @_; return "<position x=\"$x\" y=\"$y\"/>" }
sub negated { return dice(4) ? '' : ' negated="true"' }

sub add_block {
	my ($type, $x, $y, $order, @sources) = @_;
	my $me = $id++;
	my $name = grep({ $_ eq $type } @blocks) ? 'F' . ++$instances{count} : '';
	$instances{$name} = $type if $name;
	my @in = @{$pins{$type}[0]};
	$elements .= "<block localId=\"$me\" typeName=\"$type\"" . ($name ? " instanceName=\"$name\"" : '')
		. ($order ? " executionOrderId=\"$order\"" : '') . '>' . position($x, $y) . '<inputVariables>'
		. join('', map { "<variable formalParameter=\"$in[$_]\"" . negated() . '>' . point($sources[$_]) . '</variable>' } 0 .. $#in)
		. '</inputVariables><inOutVariables/><outputVariables>'
		. join('', map { "<variable formalParameter=\"$_\"><connectionPointOut/></variable>" } @{$pins{$type}[1]})
		. "</outputVariables></block>\n";
	return [$me, $pins{$type}[1][0]];
}

# Series and parallel contacts, and some that are neither.
sub ladder_body {
	my $rail = $id++;
	$elements = "<leftPowerRail localId=\"$rail\">" . position(0, 0) . "<connectionPointOut formalParameter=\"\"/></leftPowerRail>\n";
	for my $rung (1 .. 1 + dice(4)) {
		my $y = 100 * $rung;
		my @made = ([$rail]);
		for my $n (1 .. 1 + dice(5)) {
			my @from = dice(3) ? ($made[-1]) : @made < 2 || dice(2) ? ($made[dice(scalar @made)]) : @made[-2, -1];
			@from = ([$rail]) if grep { $_->[0] == $rail } @from;
			my $edge = dice(6) ? negated() : one_of(' edge="rising"', ' edge="falling"');
			my $name = $edge =~ /edge/ ? one_of(@inputs) : one_of(@inputs, @bits);
			my $me = $id++;
			$elements .= "<contact localId=\"$me\"$edge>" . position(20 * $n, $y) . point(@from) . "<connectionPointOut/><variable>$name</variable></contact>\n";
			push @made, [$me];
		}
		push @made, add_block(one_of(@blocks[0, 1]), 150, $y, 0, $made[-1]) if !dice(4);
		for my $n (0 .. dice(3)) {
			my $from = $n ? $made[1 + dice(@made - 1)] : $made[-1];
			my $more = one_of('', '', '', negated(), ' storage="set"', ' storage="reset"');
			my $me = $id++;
			$elements .= "<coil localId=\"$me\"$more>" . position(300 + dice(2), $y + 20 * $n) . point($from)
				. "<connectionPointOut/><variable>" . one_of(@bits) . "</variable></coil>\n";
		}
	}
	return "<LD>\n$elements</LD>";
}

sub diagram_body {
	$elements = '';
	my $ordered = dice(3) == 0;
	my $order = 0;
	for my $network (1 .. 1 + dice(3)) {
		my $y = 300 * $network;
		my @made;
		for my $name (map { one_of(@inputs, @bits) } 0 .. 1 + dice(3)) {
			my $me = $id++;
			$elements .= "<inVariable localId=\"$me\"" . negated() . '>' . position(0, $y + 20 * @made) . "<connectionPointOut/><expression>$name</expression></inVariable>\n";
			push @made, [$me];
		}
		my $given = @made;
		for my $n (1 .. 1 + dice(5)) {
			my $type = one_of(sort keys %pins);
			push @made, add_block($type, 100 * $n, $y + dice(3) * 40, $ordered ? ++$order : 0, map { one_of(@made) } @{$pins{$type}[0]});
		}
		for my $n (0 .. dice(3)) {
			my $me = $id++;
			$elements .= "<outVariable localId=\"$me\"" . negated() . ($ordered ? ' executionOrderId="' . ++$order . '"' : '') . '>' . position(900, $y + 30 * $n)
				. point(one_of(@made[$given .. $#made])) . '<expression>' . one_of(@bits) . "</expression></outVariable>\n";
		}
	}
	return "<FBD>\n$elements</FBD>";
}

sub project {
	my ($body) = @_;
	my $variables = join '', (map { "<variable name=\"$inputs[$_]\" address=\"%IX0.$_\"><type><BOOL/></type></variable>\n" } 0 .. $#inputs),
		(map { "<variable name=\"$bits[$_]\" address=\"%QX0.$_\"><type><BOOL/></type></variable>\n" } 0 .. $#bits),
		(map { "<variable name=\"$_\"><type><derived name=\"$instances{$_}\"/></type></variable>\n" } sort grep { $_ ne 'count' } keys %instances);
	return <<"END";
<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201">
<fileHeader companyName="C" productName="P" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="Random"><coordinateInfo><fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld><sfc><scaling x="1" y="1"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous><pou name="Main" pouType="program"><interface><localVars>
$variables</localVars></interface><body>$body</body></pou></pous></types>
<instances><configurations/></instances>
</project>
END
}

# ---- the evaluator ----
# Reads the elements of a body from the text of the XML, into a hash by localId.
sub graph_of {
	my ($xml) = @_;
	my (%graph, $count);
	my ($body) = $xml =~ /<body>(.*)<\/body>/s or die;
	while ($body =~ /<(leftPowerRail|contact|coil|block|inVariable|outVariable)\b([^>]*)>(.*?)<\/\1>/gs) {
		my ($kind, $head, $inner) = ($1, $2, $3);
		my %e = (kind => $kind, place => $count++, $head =~ /(\w+)="([^"]*)"/g);
		@e{qw(x y)} = $inner =~ /<position x="(\d+)" y="(\d+)"/;
		($e{name}) = $inner =~ /<(?:variable|expression)>([^<]*)</;
		my $sources = sub { [map { { /(\w+)="([^"]*)"/g } } $_[0] =~ /<connection ([^>]*)\/>/g] };
		if ($kind eq 'block') {
			my ($in) = $inner =~ /<inputVariables>(.*)<\/inputVariables>/s;
			while ($in =~ /<variable ([^>]*)>(.*?)<\/variable>/gs) {
				my ($pin, $wires) = ($1, $2);
				push @{$e{in}}, { $pin =~ /(\w+)="([^"]*)"/g, from => $sources->($wires) };
			}
		} else {
			$e{from} = $sources->($inner);
		}
		$graph{$e{localId}} = \%e;
	}
	return \%graph;
}

my (%value, %memory, $graph, %done);
sub edge {
	my ($key, $now, $rising) = @_;
	my $was = $memory{$key} // 0;
	$memory{$key} = $now;
	return $rising ? $now && !$was : !$now && $was;
}
sub any { my ($from) = @_; my $all = 0; for (@$from) { $all = 1 if value_of($_) } return $all }
sub truth { my ($e, $v) = @_; return ($e->{negated} // '') eq 'true' ? !$v : $v }

sub call {
	my ($e) = @_;
	return if $done{$e->{localId}}++;
	my %in = map { $_->{formalParameter} => (truth($_, any($_->{from})) ? 1 : 0) } @{$e->{in}};
	my ($type, $me) = ($e->{typeName}, $e->{localId});
	my $old = $memory{"q$me"} // 0;
	$memory{"q$me"} = ($type eq 'AND' ? $in{IN1} && $in{IN2} : $type eq 'OR' ? $in{IN1} || $in{IN2} : $type eq 'XOR' ? $in{IN1} ^ $in{IN2}
		: $type eq 'NOT' ? !$in{IN} : $type eq 'SEL' ? ($in{G} ? $in{IN1} : $in{IN0}) : $type eq 'R_TRIG' ? edge("e$me", $in{CLK}, 1)
		: $type eq 'F_TRIG' ? edge("e$me", $in{CLK}, 0) : $type eq 'SR' ? $in{S1} || (!$in{R} && $old) : !$in{R1} && ($in{S} || $old)) ? 1 : 0;
}

sub value_of {
	my ($connection) = @_;
	my $e = $graph->{$connection->{refLocalId}};
	return 1 if $e->{kind} eq 'leftPowerRail';
	return truth($e, $value{$e->{name}}) if $e->{kind} eq 'inVariable';
	if ($e->{kind} eq 'contact') {
		my $own = $e->{edge} ? $memory{"now$e->{localId}"} : truth($e, $value{$e->{name}});
		return any($e->{from}) && $own;
	}
	call($e) if !$e->{executionOrderId};
	return $memory{"q$e->{localId}"} // 0;
}

sub rank { my ($e) = @_; return $e->{executionOrderId} ? 0 : $e->{kind} eq 'block' ? 2 : 1 }
sub scan {
	%done = ();
	# Edges are of inputs, which are the same all through a scan.
	$memory{"now$_->{localId}"} = edge("e$_->{localId}", $value{$_->{name}}, $_->{edge} eq 'rising') for grep { $_->{edge} } values %$graph;
	my @acts = sort { rank($a) <=> rank($b) || ($a->{executionOrderId} // 0) <=> ($b->{executionOrderId} // 0)
		|| (abs($a->{y} - $b->{y}) < 10 ? 0 : $a->{y} <=> $b->{y}) || $a->{x} <=> $b->{x} || $a->{place} <=> $b->{place} }
		grep { $_->{kind} =~ /^(?:block|coil|outVariable)$/ } values %$graph;
	for my $e (@acts) {
		if ($e->{kind} eq 'block') { call($e); next }
		my $now = truth($e, any($e->{from})) ? 1 : 0;
		my $how = $e->{storage} // '';
		$value{$e->{name}} = $how eq 'set' ? ($now ? 1 : $value{$e->{name}}) : $how eq 'reset' ? ($now ? 0 : $value{$e->{name}}) : $now;
	}
}

sub expected {
	my ($xml, $steps) = @_;
	$graph = graph_of($xml);
	%value = map { $_ => 0 } @inputs, @bits;
	%memory = ();
	my $text = '';
	for my $n (0 .. $#$steps) {
		@value{@inputs} = @{$steps->[$n]};
		scan();
		$text .= sprintf("%d t=%d %s\n", $n + 1, 10 * ($n + 1), join ' ', map { "$_=$value{$_}" } @bits);
	}
	return $text;
}

# ---- compare ----
sub traced { my ($file) = @_; return scalar `$ladder trace $file script 2>warnings` }
for my $language (qw(LD FBD)) {
	my (@wrong, @again, $rungs);
	for my $number (1 .. $projects) {
		$seed = 1000 * $number + length $language;
		$id = 1;
		%instances = (count => 0);
		my $xml = project($language eq 'LD' ? ladder_body() : diagram_body());
		my @steps = map { [map { dice(2) } @inputs] } 1 .. $scans;
		spew('random.xml', $xml);
		spew('script', '@print ' . join(' ', @bits) . "\n" . join('', map { my $step = $_; join(' ', map { "$inputs[$_]=$step->[$_]" } 0 .. $#inputs) . "\n" } @steps));
		my $expected = expected($xml, \@steps);
		my $got = traced('random.xml');
		push @wrong, $number if $got ne $expected;
		if ($got ne $expected && @wrong == 1) {
			diag("$language $number:\n$xml\nexpected\n$expected\ngot\n$got" . `$ladder import random.xml -o random.rung 2>&1; cat random.rung`);
		}
		system("$ladder import random.xml -o random.rung >report 2>&1");
		$rungs++ if `cat random.rung` =~ /PROGRAM Main LD/;
		system("$ladder export --as plcopen random.rung -o again.xml 2>changes") == 0 or diag("$language $number: no export");
		my $back = traced('again.xml');
		push @again, $number if $back ne $expected;
		diag("$language $number again: " . `cat warnings changes` . `cat random.rung; $ladder import again.xml -o again.rung 2>&1; cat again.rung; cat again.xml`) if $back ne $expected && @again < 3;
	}
	is("@wrong", '', "$language: $projects projects do what the graph says");
	is("@again", '', "$language: and so when they were exported and imported again");
	cmp_ok($rungs, '>', $projects / 4, 'many ladders become rungs') if $language eq 'LD';
}
done_testing;
