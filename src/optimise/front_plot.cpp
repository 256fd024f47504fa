#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "optimise/report.h"

namespace roomlight::optimise {
namespace {

// Draws DATA into the svg: wheel or buttons zoom, dragging moves, a point tells its numbers, a proposed one leads to
// its section.
constexpr const char* kScript = R"(
const svg=document.getElementById('front'),tip=document.getElementById('tip'),sx=document.getElementById('axisX'),sy=document.getElementById('axisY');
const W=860,H=460,L=70,B=52,T=14,R=16;let box=null,drag=null;
DATA.axes.forEach((a,i)=>{for(const s of [sx,sy]){const o=document.createElement('option');o.value=i;o.textContent=a.title+(a.unit?' ('+a.unit+')':'');s.appendChild(o)}});
sx.value=Math.min(1,DATA.axes.length-1);sy.value=0;
function el(n,a,t){const e=document.createElementNS('http://www.w3.org/2000/svg',n);for(const k in a)e.setAttribute(k,a[k]);if(t!==undefined)e.textContent=t;return e}
function reset(){const X=+sx.value,Y=+sy.value;let x0=1e300,x1=-1e300,y0=1e300,y1=-1e300;for(const p of DATA.points){x0=Math.min(x0,p.v[X]);x1=Math.max(x1,p.v[X]);y0=Math.min(y0,p.v[Y]);y1=Math.max(y1,p.v[Y])}
const mx=(x1-x0||1)*.05,my=(y1-y0||1)*.05;box=[x0-mx,x1+mx,y0-my,y1+my];draw()}
const px=x=>L+(x-box[0])/(box[1]-box[0])*(W-L-R),py=y=>H-B-(y-box[2])/(box[3]-box[2])*(H-B-T);
function steps(a,b){const r=(b-a)/6,m=Math.pow(10,Math.floor(Math.log10(r))),s=[1,2,5,10].map(k=>k*m).find(k=>k>=r),out=[];for(let v=Math.ceil(a/s)*s;v<=b;v+=s)out.push(Math.abs(v)<s*1e-9?0:v);return out}
const number=v=>String(+v.toPrecision(4));
function draw(){svg.textContent='';const X=+sx.value,Y=+sy.value;
for(const v of steps(box[0],box[1])){svg.appendChild(el('path',{class:'grid',d:`M${px(v)} ${T}V${H-B}`}));svg.appendChild(el('text',{x:px(v),y:H-B+18,'text-anchor':'middle'},number(v)))}
for(const v of steps(box[2],box[3])){svg.appendChild(el('path',{class:'grid',d:`M${L} ${py(v)}H${W-R}`}));svg.appendChild(el('text',{x:L-8,y:py(v)+4,'text-anchor':'end'},number(v)))}
const name=a=>a.title+(a.unit?', '+a.unit:'');svg.appendChild(el('text',{x:(L+W-R)/2,y:H-10,'text-anchor':'middle',class:'axis'},name(DATA.axes[X])));svg.appendChild(el('text',{transform:`translate(16 ${(T+H-B)/2}) rotate(-90)`,'text-anchor':'middle',class:'axis'},name(DATA.axes[Y])));
const inside=p=>p.v[X]>=box[0]&&p.v[X]<=box[1]&&p.v[Y]>=box[2]&&p.v[Y]<=box[3];
for(const pass of [0,1])for(const p of DATA.points){if(!inside(p)||(p.design?1:0)!==pass)continue;const c=el('circle',{cx:px(p.v[X]),cy:py(p.v[Y]),r:p.design?7:3.2,class:p.design?'proposed':'point'});
c.addEventListener('mouseenter',e=>{tip.textContent=(p.design?'Design '+p.design+': ':'')+DATA.axes.map((a,i)=>a.title+' '+number(p.v[i])+(a.unit?' '+a.unit:'')).join(', ');tip.style.display='block';tip.style.left=(e.pageX+14)+'px';tip.style.top=(e.pageY+10)+'px'});
c.addEventListener('mouseleave',()=>tip.style.display='none');if(p.design){c.addEventListener('click',()=>location.hash='design'+p.design);svg.appendChild(c);svg.appendChild(el('text',{x:px(p.v[X])+9,y:py(p.v[Y])-7,class:'number'},p.design))}else svg.appendChild(c)}}
function zoom(f,cx,cy){const x=cx===undefined?(box[0]+box[1])/2:cx,y=cy===undefined?(box[2]+box[3])/2:cy;box=[x+(box[0]-x)*f,x+(box[1]-x)*f,y+(box[2]-y)*f,y+(box[3]-y)*f];draw()}
const where=e=>{const r=svg.getBoundingClientRect(),u=(e.clientX-r.left)/r.width*W,v=(e.clientY-r.top)/r.height*H;return [box[0]+(u-L)/(W-L-R)*(box[1]-box[0]),box[2]+(H-B-v)/(H-B-T)*(box[3]-box[2])]};
svg.addEventListener('wheel',e=>{e.preventDefault();const [x,y]=where(e);zoom(e.deltaY>0?1.2:1/1.2,x,y)},{passive:false});
svg.addEventListener('pointerdown',e=>{if(e.target.tagName!=='circle'){drag=where(e);svg.setPointerCapture(e.pointerId)}});
svg.addEventListener('pointermove',e=>{if(!drag)return;const [x,y]=where(e);const dx=drag[0]-x,dy=drag[1]-y;box=[box[0]+dx,box[1]+dx,box[2]+dy,box[3]+dy];draw()});
svg.addEventListener('pointerup',()=>drag=null);
document.getElementById('zoomIn').onclick=()=>zoom(1/1.5);document.getElementById('zoomOut').onclick=()=>zoom(1.5);document.getElementById('zoomAll').onclick=reset;sx.onchange=sy.onchange=reset;reset();
)";

}  // namespace

std::string frontPlot(const Report& r) {
  nlohmann::json data = {{"axes", nlohmann::json::array()}, {"points", nlohmann::json::array()}};
  for (const Objective o : r.model.objectives)
    data["axes"].push_back(
        {{"title", infoOf(o).title}, {"unit", o == Objective::Cost ? r.study.catalogue.currency : infoOf(o).unit}});
  for (size_t i = 0; i < r.front.size(); ++i) {
    nlohmann::json point = {{"v", nlohmann::json::array()}};
    for (const double v : r.front.objectivesOf(i)) point["v"].push_back(std::stod(fmt::format("{:.5g}", v)));
    for (size_t d = 0; d < r.designs.size(); ++d) {
      if (r.designs[d].index == i) point["design"] = d + 1;
    }
    data["points"].push_back(std::move(point));
  }
  // "</script>" in a text would end the script.
  std::string text = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  for (size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3)) text.replace(at, 2, "<\\/");
  return fmt::format(
      "<div class=\"controls\"><label>across <select id=\"axisX\"></select></label> <label>up <select "
      "id=\"axisY\"></select></label> <button id=\"zoomIn\">+</button> <button id=\"zoomOut\">−</button> <button "
      "id=\"zoomAll\">all</button></div>\n"
      "<svg id=\"front\" viewBox=\"0 0 860 460\" role=\"img\" aria-label=\"The front\"></svg><div "
      "id=\"tip\"></div>\n<script>\nconst DATA={};{}</script>\n",
      text, kScript);
}

}  // namespace roomlight::optimise
