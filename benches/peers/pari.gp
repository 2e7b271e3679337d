\\ Problem A in PARI/GP:  N=20 SCALED=0 gp -fq -D parisizemax=4G pari.gp </dev/null
\\ With SCALED=1 the start is P_0 = N!, which keeps every coefficient an integer.

N = eval(getenv("N"));
scale = if(getenv("SCALED") == "1", N!, 1);

\\ GP nests polynomials by the order of their variables; s outside E outside mu is the fastest.
s = varhigher("s"); E = 'x; mu = 'y;

\\ P is global: returned from a function, the whole list would be copied.
derive() =
{
  my(before = 0, at);
  P = vector(N + 1);
  P[1] = scale * s^0;
  for(n = 1, N,
    at = subst(P[n], s, 2*mu);
    P[n + 1] = P[n] - 2 * intformal(P[n], s) + E * (at - before);
    before = at);
}

terms(p) = if(type(p) == "t_POL", vecsum(apply(terms, Vec(p))), p != 0);

report() =
{
  my(start = getwalltime(), seconds, p, value);
  derive();
  seconds = (getwalltime() - start) / 1000;
  p = P[N + 1];
  value = subst(subst(subst(p, s, 1), E, 1/2), mu, 1/3) / scale;
  printf("terms=%d value=%s seconds=%.3f\n", terms(p), value, seconds);
}

report();
