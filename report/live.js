'use strict';
// The page that a node serves while it runs: what it is doing, the first page of the report of its last result, the verdict
// of its last explanation, and its experiments. Each part comes from the node as a server-sent event of its name.

const kStates = {idle: 'Waiting for the next experiment', collecting: 'Recording an experiment', identifying: 'Identifying',
                 error: 'Something is wrong'};
const kConnections = {[EventSource.CONNECTING]: 'The node does not answer. What is shown is the last that it told; the page goes on when it is back.',
                      [EventSource.OPEN]: '',
                      [EventSource.CLOSED]: 'The node refused to serve this page, most likely because too many others are open. Close some, and load it again.'};

/// A section that is drawn anew from what it is told. Where it is told more than the browser can draw, it draws the last.
function livePart(parent, id, title, show) {
  const content = element('div'), node = element('section', {id}, ...(title ? [element('h2', {}, title)] : []), content);
  let told = null;
  parent.append(node);
  const charts = () => Object.values(Chart.instances).filter(chart => content.contains(chart.canvas));
  const draw = () => {
    const text = told;
    told = null;
    charts().forEach(chart => chart.destroy());
    content.replaceChildren();
    show(content, JSON.parse(text));
    charts().forEach(chart => chart.resize());  // the first ones were drawn before they had neighbours
  };
  return text => {
    if (told === null) requestAnimationFrame(draw);
    told = text;
  };
}

function showNow(parent, status) {
  const {state, message, problems, running, progress, waiting_requests: requests, waiting_experiments: experiments} = status;
  const also = state === 'identifying' && status.recording ? ' and recording an experiment' : '';
  parent.append(element('p', {class: 'state ' + state}, kStates[state] + also));
  if (progress) {
    const share = Math.round(100 * progress.fraction);
    parent.append(element('p', {}, element('progress', {value: String(share), max: '100', 'aria-label': 'Progress of the identification'}),
      ` ${share}\u00a0%, ${progress.phase}`));
  }
  const waiting = [experiments > 0 ? counted(experiments, 'experiment') : '', requests > 0 ? counted(requests, 'request') : ''].filter(Boolean);
  const facts = [...running.map(({what, seconds}) => `${what}${seconds >= 1 ? `, ${number(seconds, 2)} s so far` : ''}`),
                 ...(waiting.length > 0 ? [`${listed(waiting)} waiting`] : []), ...(message ? [`Last identification: ${message}`] : [])];
  parent.append(element('ul', {class: 'facts'}, ...facts.map(text => element('li', {}, asSentence(text)))));
  if (problems.length > 0)
    parent.append(element('div', {class: 'trust red', role: 'note'}, element('h3', {}, 'To be looked at'),
      element('ul', {}, ...problems.map(text => element('li', {}, asSentence(text))))));
}

function showLiveResult(parent, result) {
  if (!result) {
    parent.append(paragraph('There is no result yet. The first one follows an experiment that can be used.', 'origin'));
    return;
  }
  parent.append(paragraph(`Result ${result.sequence}${result.preliminary ? ', a quick update: identifying from scratch follows' : ''} \u00b7 ` +
    `${counted(result.experiments.count, 'experiment')} used \u00b7 uncertainty_identification ${result.version}`, 'origin'));
  showFirstPage(parent, result);
}

function showLiveExplanation(parent, explanation) {
  if (!explanation) {
    parent.append(paragraph('Nothing has been explained yet. The service ~explain does it, or explanation.after_experiments by itself.', 'origin'));
    return;
  }
  showVerdict(parent, explanation);
}

/// What arrived, and how regularly.
function arrival({lost, jitter}) {
  return [lost > 0 ? `${counted(lost, 'message')} lost` : '', isNumber(jitter) ? `jitter ${number(1000 * jitter, 2)} ms` : ''].filter(Boolean).join(', ') || kNone;
}

function showExperiments(parent, {kept, rejected, count: all, unused}) {
  parent.append(paragraph(all === 0 ? 'None has finished yet.' : `${counted(all, 'experiment')}, of which ${count(unused)} ${unused === 1 ? 'is' : 'are'} not used.` +
    (kept.length + rejected.length < all ? ` The newest ${count(kept.length + rejected.length)} are listed.` : '')));
  const verdict = ({reason}) => (reason ? element('span', {class: 'fails'}, 'not used: ' + reason) : 'accepted');
  const listOf = (title, columns, rows) => element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': title}, table(columns, rows));
  if (kept.length > 0)
    parent.append(listOf('Experiments', [{title: 'Experiment'}, {title: 'Checks'}, {title: 'Samples', number: true}, {title: 'Sample time', number: true}, {title: 'Arrival'}],
      kept.map(one => [one.id, verdict(one), count(one.samples), `${number(one.sample_time, 3)}\u00a0s`, arrival(one)])));
  if (rejected.length > 0)
    parent.append(element('h3', {}, 'Rejected'), listOf('Rejected experiments', [{title: 'Experiment'}, {title: 'Reason'}], rejected.map(one => [one.id, one.reason])));
}

/// `source` gives the events.
function showLive(parent, source) {
  const connection = element('p', {class: 'connection', role: 'status'}, 'Connecting to the node\u2026');
  parent.append(element('header', {}, element('h1', {}, 'Identification, live'), connection));
  const parts = {status: livePart(parent, 'now', 'Now', showNow), result: livePart(parent, 'result', '', showLiveResult),
                 explanation: livePart(parent, 'explanation', 'What the simulation gets wrong', showLiveExplanation),
                 experiments: livePart(parent, 'experiments', 'Experiments', showExperiments)};
  for (const [name, tell] of Object.entries(parts)) source.addEventListener(name, event => tell(event.data));
  for (const name of ['result', 'explanation']) parts[name]('null');  // until the node tells of one
  const showConnection = () => { connection.textContent = kConnections[source.readyState]; };
  source.addEventListener('open', showConnection);
  source.addEventListener('error', showConnection);
}
